#include "lane_inputs.hpp"

#include <plait/params.h>

namespace plait::cases {
namespace {

constexpr float heavier = 1e4f; // so that masses bound stiffnesses of about 1 N/m
constexpr float free = 1e9f;    // no bound

struct Form {
    const char* name;
    uint32_t pins;
    float rate, pull;
};
constexpr Form forms[] = {{"unbounded", 0, free, free},
                          {"pins", 1, free, free},
                          {"pins, no faster", 1, 100, free},
                          {"far off", 0, free, 0.5f}};

std::vector<float> stiffnesses(size_t vertices) {
    Random random(8);
    std::vector<float> values;
    for (size_t i = 0; i < PLAIT_LANE_GROOM_COMPONENTS * vertices; ++i)
        values.push_back(static_cast<float>(random.uniform(0.5, 2)));
    return values;
}

// Every second vertex is pinned near where it is.
std::vector<float> some_pins(const LaneHair& lanes) {
    Random random(9);
    std::vector<float> pins;
    for (size_t vertex = 0; vertex < lanes.x.size() / 3; ++vertex) {
        for (size_t axis = 0; axis < 3; ++axis)
            pins.push_back(lanes.x[3 * vertex + axis] +
                           static_cast<float>(random.uniform(-0.1, 0.1)));
        pins.push_back(vertex % 2 ? static_cast<float>(random.uniform(0.5, 2)) : 0.0f);
    }
    return pins;
}

} // namespace

Case lane_groom_case() {
    Case result = {PLAIT_STAGE_lane_groom, {}, {{"lane_spring", 2e-5}}, {}};
    result.unread = {"lane_material.length",   "lane_material.stretch", "lane_material.bend",
                     "lane_material.twist",    "lane_material.cross",   "lane_material.drag",
                     "lane_material.friction", "lane_material.wetness"};
    for (const Size& size : sizes())
        for (const Form& form : forms) {
            LaneHair lanes = make_lane_hair(size, 67);
            for (size_t i = PLAIT_LANE_MASS; i < lanes.material.size();
                 i += PLAIT_LANE_MATERIAL_COMPONENTS)
                lanes.material[i] *= heavier;
            Setup setup;
            setup.name = name_of(size) + ", " + form.name;
            setup.items = size.strands;
            setup.width = size.stride;
            setup.buffers = {
                null_array(),
                uints(lanes.hair.vertex_count),
                float4s(lanes.hair.rest),
                float4s(lanes.hair.pose),
                lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS),
                lane_floats(stiffnesses(lanes.x.size() / 3), PLAIT_LANE_GROOM_COMPONENTS),
                lane_floats(lanes.x, 3),
                lane_floats(lanes.v, 3),
                lane_floats(some_pins(lanes), 4)};
            result.setups.push_back(setup.with(plait_lane_groom_params{
                size.stride, 1, size.stride, form.pins, 0.8f, 0.3f, form.rate, form.pull}));
            if (&form != &forms[1])
                continue;
            setup.name += ", reordered";
            setup.buffers[0] = uints(other_order(size.strands, size.strands));
            result.setups.push_back(setup);
        }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
