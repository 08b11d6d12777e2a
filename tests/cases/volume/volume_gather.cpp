#include "lane_inputs.hpp"
#include "volume/volume_inputs.hpp"

namespace plait::cases {
namespace {

// Of a node a change of velocity and a share, and an acceleration.
std::vector<float> pulls(uint32_t nodes) {
    Random random(nodes), shares(nodes + 1);
    std::vector<float> values;
    for (uint32_t node = 0; node < nodes; ++node)
        for (const double most : {.5, 9.}) {
            for (int axis = 0; axis < 3; ++axis)
                values.push_back(static_cast<float>(random.uniform(-most, most)));
            values.push_back(most < 1 ? static_cast<float>(shares.uniform(.2, .4)) : 0);
        }
    return values;
}

} // namespace

Case volume_gather_case() {
    Case result = {PLAIT_STAGE_volume_gather,
                   {},
                   {{"lane_v", 1e-6}, {"lane_v_before", 1e-6}, {"lane_pressure", 3e-5}},
                   {"wet", "soaked"}};
    for (const GridHair& hair : make_grid_hair())
        for (const uint32_t moves : {1u, 0u}) {
            const LaneGridHair lanes = over_lanes(hair);
            plait_lane_volume_params params = volume_params_of(lanes.params);
            params.moves = moves;
            params.history = hair.size.stride % 2;
            Setup setup = hair.setup().with(params);
            setup.name += moves ? ", moves" : ", still";
            setup.items = hair.size.strands;
            setup.width = hair.size.stride;
            setup.buffers = {null_array(),
                             uints(hair.vertex_count),
                             lane_floats(lanes.x, 3),
                             float4s(pulls(hair.voxels())),
                             lane_floats(lanes.v, 3),
                             lane_floats(lanes.v_before, 3),
                             lane_floats(std::vector<float>(lanes.x.size(), 9), 3)};
            result.setups.push_back(setup);
            if (hair.size.strands < 3 || !moves)
                continue;
            setup.name += ", reordered";
            setup.buffers[0] = uints(other_order(hair.size.strands, hair.size.strands));
            result.setups.push_back(setup);
        }
    return result;
}

} // namespace plait::cases
