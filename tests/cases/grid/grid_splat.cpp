#include "grid/grid_inputs.hpp"

namespace plait::cases {
namespace {

std::string compare_sums_of_splat(const Setup&, const Outputs& expected, const Outputs& got) {
    return compare_sums(expected[3], got[3]);
}

} // namespace

Case grid_splat_case() {
    Case result = {PLAIT_STAGE_grid_splat,
                   {},
                   {},
                   {"slot_hash", "frame", "seed", "diffuse_rule", "diffuse_ratio", "diffuse_factor",
                    "diffuse_floor", "position.w"},
                   {{"grid_sum", compare_sums_of_splat}}};
    for (GridHair hair : make_grid_hair())
        for (uint32_t tent : {PLAIT_TENT_VOXEL, PLAIT_TENT_TRILINEAR}) {
            hair.params.tent = tent;
            Setup setup = hair.setup();
            setup.name += tent == PLAIT_TENT_VOXEL ? ", voxel" : ", trilinear";
            setup.items = hair.size.strands;
            const size_t words = size_t{hair.voxels()} * PLAIT_SUM_STRIDE;
            setup.buffers = {uints(hair.vertex_count), float4s(hair.position),
                             float4s(hair.position_prev), uints(std::vector<uint32_t>(words, 0)),
                             uints({7})};
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
