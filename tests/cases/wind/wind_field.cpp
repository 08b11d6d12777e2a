#include "inputs.hpp"

#include <plait/params.h>

#include <algorithm>
#include <string>

namespace plait::cases {
namespace {

// A corner near where the cells' numbers begin again, in a grid that is turned.
plait_wind_field_params params_of(uint32_t edge_count, uint32_t octaves) {
    Random random(edge_count);
    const auto q = random.rotation();
    plait_wind_field_params params{};
    params.edge_count = edge_count;
    params.voxel_edge = 0.37f;
    std::copy(q.begin(), q.end(), params.q);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        params.cell[axis] = 0xffffffffu - axis;
        params.fraction[axis] = 0.2f + 0.3f * static_cast<float>(axis);
    }
    params.amplitude = 2;
    params.octaves = octaves;
    params.gain = 0.6f;
    params.seed = 4711;
    return params;
}

} // namespace

// The finest octave's derivatives multiply the rounding of places by 2^octaves.
Case wind_field_case() {
    Case result = {PLAIT_STAGE_wind_field, {}, {{"wind_velocity", 2e-4}}};
    for (const uint32_t edge_count : {1u, 5u, 8u})
        for (const uint32_t octaves : {1u, 3u, 4u}) {
            Setup setup;
            setup.name =
                std::to_string(edge_count) + " voxels, " + std::to_string(octaves) + " octaves";
            setup.items = edge_count * edge_count * edge_count;
            setup.buffers = {unwritten_float4s(setup.items)};
            result.setups.push_back(setup.with(params_of(edge_count, octaves)));
        }
    return result;
}

} // namespace plait::cases
