#include "lane_inputs.hpp"

namespace plait::cases {

// Stiffnesses on both sides of both bounds. A target may be metres away.
Case lane_pin_case() {
    Case result = {PLAIT_STAGE_lane_pin, {}, {{"lane_pin", 2e-5}}, {}};
    result.unread = {"lane_material.stretch", "lane_material.bend", "lane_material.twist",
                     "lane_material.cross",   "lane_material.drag", "lane_material.friction",
                     "lane_material.wetness"};
    result.flags = {"pin_from.w"};
    for (const Size& size : sizes())
        for (const float rate : {2e6f, 10.0f}) {
            const LaneHair lanes = make_lane_hair(size, 53);
            Setup setup;
            setup.name = name_of(size);
            setup.items = size.strands;
            setup.width = size.stride;
            setup.buffers = {null_array(),
                             uints(lanes.hair.vertex_count),
                             float4s(lanes.hair.rest),
                             float4s(lanes.hair.pose),
                             lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS),
                             float4s(pin_rows(size, 54)),
                             float4s(pin_rows(size, 55)),
                             lane_floats(lanes.x, 3),
                             lane_floats(lanes.v, 3),
                             lane_floats(std::vector<float>(lanes.q.size(), 9), 4)};
            const float pull = rate > 100 ? 1e9f : 1e6f; // no bound, or that of most
            result.setups.push_back(setup.with(
                plait_lane_pin_params{size.stride, 1, size.stride, 0.7f, 15000, rate, 0.3f, pull}));
            if (rate > 100)
                continue;
            const std::vector<uint32_t> list = other_order(size.strands, size.strands);
            setup.name += ", reordered";
            setup.buffers[0] = uints(list);
            result.setups.push_back(setup);
        }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
