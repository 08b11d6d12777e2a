// The caller's own kernel in the place of one that plait has, through the C API: with work-group
// memory and the headers that plait's kernels share.
#include "support.hpp"

#include <plait/plait.hpp>

#include <array>
#include <vector>

namespace {

// Still air below y = 0, full wind from 0.2 m above it; linear drag.
constexpr const char* boundary_layer = R"(
#include "base/strand.clh"
#include "plait/params.h"

__kernel void plait_tressfx_wind(const uint item_count, const plait_tressfx_wind_params params,
                         __global const uint* vertex_count, __global const float4* position_prev,
                         __global float4* position, __local float4* shared_position) {
    const strand_item_t item = strand_item(params.vertex_stride);
    if (item.strand >= item_count || item.vertex >= vertex_count[item.strand])
        return;
    const float4 x = position[item.element];
    if (!is_free(x))
        return;
    const float3 air = clamp(x.y / 0.2f, 0.0f, 1.0f) * vload4(0, params.wind).xyz;
    const float3 v = (x.xyz - position_prev[item.element].xyz) / params.h;
    position[item.element] = x + (float4)(params.h * params.h * params.drag * (air - v), 0.0f);
}
)";

constexpr size_t strands = 16, vertices = 16;

plait::Context make_context(const std::string& device, const plait_stage_source* own) {
    plait_context_desc desc = plait_context_desc_defaults();
    desc.backend = "opencl";
    desc.device = device.c_str();
    desc.stage_sources = own;
    desc.stage_source_count = own ? 1 : 0;
    return plait::Context(desc);
}

// How far a wind of 5 m/s along z carries the tips of strands grown sideways in half a second, on
// average, m.
double drift(const plait::Context& context, float gravity) {
    std::vector<std::array<float, 3>> rest;
    for (size_t strand = 0; strand < strands; ++strand)
        for (size_t vertex = 0; vertex < vertices; ++vertex)
            rest.push_back({0.2f * static_cast<float>(vertex) / (vertices - 1), 0,
                            0.01f * static_cast<float>(strand)});
    plait_groom_desc hair = plait_groom_desc_defaults();
    hair.positions = plait::view(rest);
    hair.vertices_per_strand = vertices;
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX; // of which wind is a stage
    desc.tressfx.local_stiffness = 0; // limp
    desc.params.gravity[1] = gravity;
    desc.tressfx.wind[2] = 5;
    desc.tressfx.air_drag = 2;
    plait::Sim sim(context, plait::Groom(hair), desc);
    for (int frame = 0; frame < 30; ++frame)
        sim.step(1.0 / 60);
    const std::vector<float> positions = sim.read(PLAIT_FIELD_POSITION);
    double sum = 0;
    for (size_t strand = 0; strand < strands; ++strand)
        sum += positions[4 * (vertices * strand + vertices - 1) + 2] - rest[vertices * strand][2];
    return sum / strands;
}

class OwnWind : public plait::opencl::OnDevice {};
INSTANTIATE_TEST_SUITE_P(Devices, OwnWind, ::testing::ValuesIn(plait::opencl::device_indices()),
                         plait::opencl::test_name);

TEST_P(OwnWind, TakesThePlaceOfPlaits) {
    const std::string device = plait::opencl::find_devices().usable[GetParam()].info.name;
    const plait_stage_source own = {"tressfx_wind", boundary_layer, "boundary_layer.cl"};
    const plait::Context ours = make_context(device, &own), usual = make_context(device, nullptr);
    EXPECT_NEAR(drift(ours, -9.81f), 0, 1e-3); // it hangs, below the wind
    EXPECT_GT(drift(ours, 9.81f), 0.01);
    EXPECT_GT(drift(usual, -9.81f), 0.01);
}

} // namespace
