#include "lane_inputs.hpp"

namespace plait::cases {

// A rotation of offsets of up to 5 m; without a turn the roots alone.
Case lane_carry_case() {
    Case result = {PLAIT_STAGE_lane_carry,
                   {},
                   {{"lane_x", 4e-6},
                    {"lane_v", 2e-6},
                    {"lane_q", 1e-6},
                    {"lane_q_before", 1e-6},
                    {"lane_x_before", 4e-6},
                    {"lane_v_before", 2e-6}},
                   {},
                   {},
                   {},
                   {},
                   {"q"}}; // of those that turn
    for (const Size& size : sizes())
        for (const uint32_t turns : {1u, 0u}) {
            const LaneHair lanes = make_lane_hair(size, 49);
            Setup setup;
            setup.name = name_of(size) + (turns ? ", turned" : "");
            setup.items = size.strands;
            setup.width = size.stride;
            setup.buffers = {lane_floats(lanes.x, 3),        lane_floats(lanes.v, 3),
                             lane_floats(lanes.q, 4),        lane_floats(lanes.q_before, 4),
                             lane_floats(lanes.x_before, 3), lane_floats(lanes.v_before, 3)};
            result.setups.push_back(setup.with(plait_carry_params{
                size.stride, 1, 1, turns, {0.48f, 0.6f, 0, 0.64f}, {0.3f, -0.2f, 0.7f, 0}}));
        }
    return result;
}

} // namespace plait::cases
