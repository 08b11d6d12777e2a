#include "lane_inputs.hpp"

namespace plait::cases {

// Differences of values below 8 m, divided by h = 1/60 s.
Case lane_pack_case() {
    Case result = {
        PLAIT_STAGE_lane_pack,
        {},
        {{"lane_x", 1e-6}, {"lane_v", 6e-5}, {"lane_x_before", 2e-6}, {"lane_v_before", 6e-5}},
        {"position.w", "lane_normal_force"}}; // pinned or not; only taken back
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 37);
        Setup setup;
        setup.name = name_of(size);
        setup.items = lanes.hair.vertices();
        setup.buffers = {null_array(),
                         uints(lanes.hair.vertex_count),
                         float4s(lanes.hair.position),
                         float4s(lanes.hair.position_prev),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         lane_floats(lanes.x_before, 3),
                         lane_floats(lanes.v_before, 3),
                         lane_floats(lanes.normal_force, 1)};
        result.setups.push_back(
            setup.with(plait_lane_history_params{size.stride, 1, size.stride, 1.0f / 60, 1}));
        setup.name += ", as it moves now";
        result.setups.push_back(
            setup.with(plait_lane_history_params{size.stride, 1, size.stride, 1.0f / 60, 2}));
        // all strands but one, in another order
        setup.name += ", reordered";
        setup.items -= size.stride;
        setup.buffers[0] = uints(other_order(size.strands, size.strands - 1));
        // the step before is there, so that keeping it is a fair disturbance
        result.setups.push_back(
            setup.with(plait_lane_history_params{size.stride, 1, size.stride, 1.0f / 60, 0}));
    }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
