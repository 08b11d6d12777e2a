#include "inputs.hpp"

#include <plait/params.h>

#include <algorithm>

namespace plait::cases {
namespace {

plait_wind_shelter_params params_of(uint32_t edge_count, uint32_t axis, uint32_t plane) {
    Random random(edge_count + axis);
    const auto q = random.rotation();
    plait_wind_shelter_params params{};
    params.edge_count = edge_count;
    params.voxel_edge = 0.1f;
    std::copy(q.begin(), q.end(), params.q);
    params.axis = axis;
    params.plane = plane;
    params.reversed = (axis + plane) % 2;
    params.foot[0] = 0.37f;
    params.foot[1] = -0.81f;
    params.way = 0.13f;
    params.turbulent = axis != 1;
    for (int i = 0; i < 3; ++i) {
        params.air[i] = static_cast<float>(random.uniform(-3, 3));
        params.still[i] = static_cast<float>(random.uniform(-3, 3));
    }
    return params;
}

std::vector<float> values(uint32_t count, double low, double high, uint32_t gap) {
    Random random(count + gap);
    std::vector<float> list;
    for (uint32_t i = 0; i < count; ++i)
        list.push_back(gap > 0 && i % gap == 1 ? 0.0f
                                               : static_cast<float>(random.uniform(low, high)));
    return list;
}

} // namespace

Case wind_shelter_case() {
    Case result = {PLAIT_STAGE_wind_shelter, {}, {{"wind_depth", 2e-6}, {"wind_velocity", 1e-5}}};
    result.unread = {"voxel_edge", "grid_velocity.rms", "wind_velocity.open"};
    result.flags.push_back("grid_density"); // none, or some
    for (const uint32_t edge_count : {1u, 2u, 7u})
        for (const uint32_t axis : {0u, 1u, 2u})
            for (uint32_t plane = 0; plane < std::min(edge_count, 3u); ++plane) {
                const uint32_t nodes = edge_count * edge_count * edge_count;
                Setup setup;
                setup.name = std::to_string(edge_count) + " voxels, plane " +
                             std::to_string(plane) + " along " + std::to_string(axis);
                setup.items = 1;
                setup.width = axis == 1 ? 1 : 3;
                setup.buffers = {floats(values(nodes, 0, 9, 4)), floats(values(nodes, 1, 90, 3)),
                                 float4s(values(4 * nodes, -2, 2, 0)),
                                 floats(values(nodes, 0, 1.5, 0)),
                                 float4s(values(4 * nodes, -1, 1, 0))};
                result.setups.push_back(setup.with(params_of(edge_count, axis, plane)));
            }
    return result;
}

} // namespace plait::cases
