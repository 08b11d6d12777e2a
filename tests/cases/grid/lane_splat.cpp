#include "grid/grid_inputs.hpp"
#include "lane_inputs.hpp"

namespace plait::cases {
namespace {

std::string compare_sums_of_lanes(const Setup&, const Outputs& expected, const Outputs& got) {
    return compare_sums(expected[4], got[4]);
}

} // namespace

Case lane_splat_case() {
    Case result = {
        PLAIT_STAGE_lane_splat,
        {},
        {},
        {"diffuse_rule", "diffuse_ratio", "diffuse_factor", "diffuse_floor", "history", "each"},
        {{"grid_sum", compare_sums_of_lanes}}};
    std::vector<GridHair> hairs = make_grid_hair();
    hairs.push_back(make_much_grid_hair());
    for (GridHair& hair : hairs)
        for (uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
            hair.params.tent = tent;
            const LaneGridHair lanes = over_lanes(hair);
            Setup setup = hair.setup().with(lanes.params);
            setup.name += tent == PLAIT_TENT_VOXEL ? ", voxel" : ", trilinear";
            setup.items = hair.size.strands;
            setup.width = hair.size.stride;
            const size_t words = size_t{hair.voxels()} * PLAIT_SUM_STRIDE;
            setup.buffers = {null_array(),
                             uints(hair.vertex_count),
                             lane_floats(lanes.x, 3),
                             lane_floats(lanes.v, 3),
                             uints(std::vector<uint32_t>(words, 0)),
                             uints({7})};
            result.setups.push_back(setup);
            plait_lane_grid_params each = lanes.params;
            each.each = 1;
            result.setups.push_back(setup.with(each));
            result.setups.back().name += ", each rounded";
            if (hair.size.strands < 3)
                continue;
            // all strands but one, in another order
            setup.name += ", reordered";
            setup.items -= 1;
            setup.buffers[0] = uints(other_order(hair.size.strands, hair.size.strands - 1));
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
