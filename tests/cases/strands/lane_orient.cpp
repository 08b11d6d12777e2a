#include "lane_inputs.hpp"

namespace plait::cases {

// A turn is a product of up to 256 rounded quaternions between directions, as in guide_turns.
Case lane_orient_case() {
    Case result = {PLAIT_STAGE_lane_orient, {}, {{"lane_q", 1e-5}, {"lane_q_before", 1e-5}}, {}};
    result.unread = {"lane_material.length",
                     "lane_material.mass",
                     "lane_material.stretch",
                     "lane_material.drag",
                     "lane_material.friction",
                     "lane_material.wetness",
                     "pose.t"};
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 35), elsewhere = make_lane_hair(size, 36);
        Setup setup;
        setup.name = name_of(size);
        setup.items = size.strands;
        setup.width = size.stride;
        setup.buffers = {null_array(),
                         float4s(lanes.hair.pose),
                         lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS),
                         lane_floats(lanes.rest, 4),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.x_before, 3),
                         lane_floats(lanes.q, 4),
                         lane_floats(lanes.q_before, 4)};
        setup.name = name_of(size) + ", before";
        result.setups.push_back(setup.with(plait_lane_orient_params{size.stride, 1, 1}));
        // x_before is there, so that reading it is a fair disturbance
        setup.name = name_of(size) + ", aligned";
        result.setups.push_back(setup.with(plait_lane_orient_params{size.stride, 1, 0}));
        setup.name = name_of(size) + ", elsewhere";
        setup.buffers[4] = lane_floats(elsewhere.x, 3);
        result.setups.push_back(setup.with(plait_lane_orient_params{size.stride, 1, 0}));
        result.setups.push_back(
            reordered(setup, {1}).with(plait_lane_orient_params{size.stride, 1, 0}));
    }
    return result;
}

} // namespace plait::cases
