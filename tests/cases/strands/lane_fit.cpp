#include "lane_inputs.hpp"

namespace plait::cases {

// A sum of up to 255 segments of 2 cm, each as exact as the difference of two rounded positions of
// up to 5 m; velocities are copied.
Case lane_fit_case() {
    Case result = {PLAIT_STAGE_lane_fit,
                   {},
                   {{"lane_x", 1e-4}, {"lane_x_before", 1e-4}, {"lane_v_before", 0}},
                   {"lane_x_before", "lane_v_before"}}; // written or kept
    for (const char* other :
         {"stretch", "bend", "mass", "twist", "cross", "drag", "friction", "wetness"})
        result.unread.push_back(std::string("lane_material.") + other);
    struct Way {
        uint32_t history, lengths;
        const char* name;
    };
    for (const Size& size : sizes())
        for (const Way& way : {Way{0, 1, ""}, Way{1, 1, ", BDF2"}, Way{1, 0, ", BDF2 alone"}}) {
            LaneHair lanes = make_lane_hair(size, 43);
            for (size_t i = 0; i < lanes.x.size(); i += 7)
                lanes.x[i] *= 1.01f; // as no strand that keeps its lengths
            for (float& v : lanes.v)
                v *= 10;
            Setup setup;
            setup.name = name_of(size) + way.name;
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
                plait_lane_fit_params{size.stride, 1, 1.0f / 60, way.history, way.lengths}));
        }
    return result;
}

} // namespace plait::cases
