#include "lane_inputs.hpp"

namespace plait::cases {

// A sum of up to 255 segments of 2 cm, each as exact as the difference of two rounded positions of
// up to 5 m; velocities are copied.
Case lane_fit_case() {
    Case result = {PLAIT_STAGE_lane_fit,
                   {},
                   {{"lane_x", 1e-4}, {"lane_x_before", 1e-4}, {"lane_v_before", 0}},
                   {"lane_x_before", "lane_v_before"}}; // written or kept
    for (const char* other : {"stretch", "bend", "mass", "twist", "cross"})
        result.unread.push_back(std::string("lane_material.") + other);
    for (const Size& size : sizes())
        for (const uint32_t history : {0u, 1u}) {
            LaneHair lanes = make_lane_hair(size, 43);
            for (size_t i = 0; i < lanes.x.size(); i += 7)
                lanes.x[i] *= 1.01f; // as no strand that keeps its lengths
            for (float& v : lanes.v)
                v *= 10;
            Setup setup;
            setup.name = name_of(size) + (history ? ", BDF2" : "");
            setup.items = (size.strands + 1) / 2;
            std::vector<uint32_t> slots;
            for (const uint32_t lane : other_order(size.strands, setup.items))
                slots.insert(slots.end(), {0, lane});
            setup.buffers = {uints(slots),
                             lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS),
                             lane_floats(lanes.v, 3),
                             lane_floats(lanes.x, 3),
                             lane_floats(lanes.x_before, 3),
                             lane_floats(lanes.v_before, 3)};
            result.setups.push_back(setup.with(
                plait_lane_history_params{size.stride, 1, size.stride, 1.0f / 60, history}));
        }
    return result;
}

} // namespace plait::cases
