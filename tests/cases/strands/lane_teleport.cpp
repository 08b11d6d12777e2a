#include "lane_inputs.hpp"

namespace plait::cases {

// Two rotations of offsets of up to 5 m.
Case lane_teleport_case() {
    Case result = {PLAIT_STAGE_lane_teleport,
                   {},
                   {{"lane_x", 4e-6},
                    {"lane_v", 1e-6},
                    {"lane_q", 1e-6},
                    {"lane_q_before", 1e-6},
                    {"lane_x_before", 4e-6},
                    {"lane_v_before", 1e-6}},
                   {"pose_from.t"}}; // all but the root's rows are relative to it
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 35);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(),
                         float4s(lanes.hair.rest),
                         float4s(lanes.hair.pose),
                         float4s(lanes.hair.pose_other),
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
