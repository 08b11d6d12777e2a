#include "lane_inputs.hpp"

namespace plait::cases {

// Orientations are those of guide_turns, times the joints. Velocities are differences of positions of
// up to 2 m, over a step.
Case level_wake_case() {
    const std::vector<std::string> of_others = {"lane_x",
                                                "lane_v",
                                                "lane_q",
                                                "lane_q_before",
                                                "lane_x_before",
                                                "lane_v_before",
                                                "lane_normal_force",
                                                "position.w"};
    Case result = {PLAIT_STAGE_level_wake,
                   {},
                   {{"lane_x", 1e-5},
                    {"lane_v", 2e-4},
                    {"lane_q", 1e-4},
                    {"lane_q_before", 1e-4},
                    {"lane_x_before", 1e-5},
                    {"lane_v_before", 2e-4}},
                   of_others}; // of the strands before them kept
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 71);
        const Hair& hair = lanes.hair;
        Setup setup;
        setup.name = name_of(size);
        const uint32_t first = size.strands / 3;
        setup.items = size.strands - first;
        setup.buffers = {null_array(),
                         float4s(hair.rest),
                         float4s(hair.pose_other),
                         float4s(hair.pose),
                         float4s(hair.position_prev2),
                         float4s(hair.position_prev),
                         float4s(hair.position),
                         lane_floats(lanes.rest, 4),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         lane_floats(lanes.q, 4),
                         lane_floats(lanes.q_before, 4),
                         lane_floats(lanes.x_before, 3),
                         lane_floats(lanes.v_before, 3),
                         lane_floats(lanes.normal_force, 1)};
        result.setups.push_back(setup.with(
            plait_level_wake_params{size.stride, 1, size.stride, first, 1, 1.0f / 120, 1.0f / 60}));
        std::vector<uint32_t> order;
        for (uint32_t lane = 0; lane < size.strands; ++lane)
            order.push_back(size.strands - 1 - lane);
        setup.name += ", in another order";
        setup.buffers[0] = uints(order);
        result.setups.push_back(setup.with(
            plait_level_wake_params{size.stride, 1, size.stride, first, 1, 1.0f / 60, 1.0f / 60}));
    }
    return result;
}

} // namespace plait::cases
