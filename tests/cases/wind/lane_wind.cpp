#include "lane_inputs.hpp"

#include <plait/params.h>

#include <algorithm>

namespace plait::cases {
namespace {

constexpr float heavier = 1e4f; // so that springs have stiffnesses of about 1 N/m

struct Form {
    const char* name;
    uint32_t bdf2, pins, accelerates, pressure, field;
};
constexpr Form forms[] = {{"still", 0, 0, 0, 0, 0},
                          {"accelerations", 0, 0, 1, 0, 0},
                          {"BDF2, pins", 1, 1, 1, 0, 0},
                          {"BDF2, field", 1, 0, 0, 1, 1},
                          {"all", 1, 1, 1, 1, 1}};

plait_lane_wind_params params_of(const Size& size, const Form& form) {
    plait_lane_wind_params params{};
    params.vertex_stride = params.row_stride = size.stride;
    params.tile = 1;
    params.h = 1.0f / 30;
    params.bdf2 = form.bdf2;
    params.pins = form.pins;
    params.accelerates = form.accelerates;
    params.pressure = form.pressure;
    params.drag = 4.2e-5f * heavier;
    params.viscous = 3.6f;
    params.tangential = 0.4f;
    const float air[] = {1.5f, -0.8f, 1.1f}, jump[] = {0.7f, 0.9f, -0.4f};
    std::copy_n(air, 3, params.air);
    std::copy_n(jump, 3, params.jump);
    params.field = form.field;
    params.edge_count = 4;
    params.voxel_edge = 0.3f;
    Random random(7);
    const auto q = random.rotation();
    std::copy(q.begin(), q.end(), params.q);
    const auto corner = rotate(q, {-0.6, -0.6, -0.6}); // the hair is around the origin
    std::copy(corner.begin(), corner.end(), params.t);
    return params;
}

std::vector<float> nodes(uint32_t edge_count) {
    Random random(edge_count);
    std::vector<float> velocities;
    for (uint32_t node = 0; node < edge_count * edge_count * edge_count; ++node) {
        for (int axis = 0; axis < 3; ++axis)
            velocities.push_back(static_cast<float>(random.uniform(-2, 2)));
        velocities.push_back(static_cast<float>(random.uniform(0, 1)));
    }
    return velocities;
}

std::vector<float> pressures(size_t count) {
    Random random(5);
    std::vector<float> values;
    for (size_t i = 0; i < count; ++i)
        values.push_back(static_cast<float>(random.uniform(-9, 9)));
    return values;
}

// Every second vertex is pinned a centimetre from where it is, about as stiffly as by drag.
std::vector<float> some_pins(const LaneHair& lanes) {
    Random random(3);
    std::vector<float> pins;
    for (size_t vertex = 0; vertex < lanes.x.size() / 3; ++vertex) {
        for (size_t axis = 0; axis < 3; ++axis)
            pins.push_back(lanes.x[3 * vertex + axis] +
                           static_cast<float>(random.uniform(-0.01, 0.01)));
        pins.push_back(vertex % 2 ? static_cast<float>(random.uniform(0.5, 5)) : 0.0f);
    }
    return pins;
}

} // namespace

Case lane_wind_case() {
    Case result = {PLAIT_STAGE_lane_wind, {}, {{"lane_push", 2e-3}, {"lane_spring", 4e-5}}};
    result.unread = {"lane_material.stretch", "lane_material.bend",     "lane_material.twist",
                     "lane_material.cross",   "lane_material.friction", "lane_material.wetness"};
    for (const Size& size : sizes())
        for (const Form& form : forms) {
            LaneHair lanes = make_lane_hair(size, 61);
            for (size_t i = PLAIT_LANE_MASS; i < lanes.material.size();
                 i += PLAIT_LANE_MATERIAL_COMPONENTS)
                lanes.material[i] *= heavier;
            Setup setup;
            setup.name = name_of(size) + ", " + form.name;
            setup.items = size.strands;
            setup.width = size.stride;
            setup.buffers = {null_array(),
                             uints(lanes.hair.vertex_count),
                             float4s(lanes.hair.rest),
                             float4s(lanes.hair.pose),
                             float4s(accelerations(size, 10)),
                             float4s(nodes(4)),
                             lane_floats(lanes.material, PLAIT_LANE_MATERIAL_COMPONENTS),
                             lane_floats(lanes.x, 3),
                             lane_floats(lanes.v, 3),
                             lane_floats(lanes.x_before, 3),
                             lane_floats(lanes.v_before, 3),
                             lane_floats(pressures(lanes.x.size()), 3),
                             lane_floats(std::vector<float>(lanes.x.size(), 9), 3),
                             lane_floats(some_pins(lanes), 4)};
            result.setups.push_back(setup.with(params_of(size, form)));
            if (&form != &forms[4])
                continue;
            setup.name += ", reordered";
            setup.buffers[0] = uints(other_order(size.strands, size.strands));
            result.setups.push_back(setup);
        }
    add_longer_rows(result);
    return result;
}

} // namespace plait::cases
