#include "lane_inputs.hpp"

namespace plait::cases {

// An orientation is a product of up to 256 rounded quaternions and as many turns between directions
// whose rounding is that of a difference of positions of up to 5 m, over a segment of 2 cm.
Case lane_orient_case() {
    Case result = {PLAIT_STAGE_lane_orient,
                   {},
                   {{"lane_q", 1e-4}, {"lane_q_before", 1e-4}},
                   {"pose.t", "lane_q", "lane_q_before"}}; // directions only; written or kept
    for (const Size& size : sizes()) {
        const LaneHair lanes = make_lane_hair(size, 41);
        Setup setup;
        setup.name = name_of(size);
        setup.items = (size.strands + 1) / 2;
        std::vector<uint32_t> slots;
        for (const uint32_t lane : other_order(size.strands, setup.items))
            slots.insert(slots.end(), {0, lane});
        setup.buffers = {uints(slots),
                         null_array(),
                         float4s(lanes.hair.pose),
                         lane_floats(lanes.rest, 4),
                         lane_floats(lanes.x, 3),
                         lane_floats(lanes.v, 3),
                         lane_floats(lanes.q, 4),
                         lane_floats(lanes.q_before, 4)};
        result.setups.push_back(
            setup.with(plait_lane_layout_params{size.stride, 1, size.stride, 1.0f / 60}));
        setup.name += ", reordered";
        setup.buffers[1] = uints(other_order(size.strands, size.strands));
        result.setups.push_back(
            setup.with(plait_lane_layout_params{size.stride, 1, size.stride, 1.0f / 60}));
    }
    return result;
}

} // namespace plait::cases
