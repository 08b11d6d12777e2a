#include "lane_inputs.hpp"

namespace plait::cases {

// Rotations of points below 2 m; an orientation is a product of up to 256 rounded quaternions.
Case lane_reset_case() {
    Case result = {
        PLAIT_STAGE_lane_reset,
        {},
        {{"lane_x", 2e-6}, {"lane_x_before", 2e-6}, {"lane_q", 2e-5}, {"lane_q_before", 2e-5}}};
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 34);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(),
                         float4s(lanes.hair.rest),
                         float4s(lanes.hair.pose),
                         lane_floats(lanes.rest, 4),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         lane_floats(lanes.q, 4),
                         lane_floats(lanes.q_before, 4),
                         lane_floats(lanes.x_before, 3),
                         lane_floats(lanes.v_before, 3),
                         lane_floats(lanes.normal_force, 1)};
        result.setups.push_back(
            setup.with(plait_lane_state_params{size.stride, 1, size.stride, 1}));
        result.setups.push_back(
            reordered(setup).with(plait_lane_state_params{size.stride, 1, size.stride, 1}));
    }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
