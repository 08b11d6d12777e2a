#include "grid/solid_inputs.hpp"

namespace plait::cases {
namespace {

Setup make(uint32_t edge_count, bool others) {
    NearestMeshes meshes;
    Random random(edge_count + 3);
    add_ball(meshes, random, false, others); // another, before it
    add_ball(meshes, random, false, true);
    for (int i = 0; i < 3; ++i) // of the substep before, and of that one
        add_solid_row(meshes.rows, random, {0.3, 0.7});
    const uint32_t nodes = edge_count * edge_count * edge_count,
                   triangles = meshes.first[PLAIT_MESH_FIRST_STRIDE + PLAIT_MESH_FIRST_COUNT];
    std::vector<uint32_t> passed((nodes + 31) / 32), met(nodes);
    for (uint32_t& bits : passed)
        bits = random.below(0xffffffffu);
    for (uint32_t& triangle : met)
        triangle = random.below(triangles + 1);
    std::vector<float> other;
    for (uint32_t node = 0; node < nodes; ++node)
        append_floats(other, {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2),
                              double(node % 2)});
    Setup setup;
    setup.name = std::to_string(edge_count) + " nodes along an edge" + (others ? ", others" : "");
    setup.items = edge_count * edge_count;
    setup.buffers = {float4s(meshes.rows), uints(meshes.first), uints(meshes.triangle),
                     float4s(meshes.from), float4s(meshes.to),  uints(passed),
                     uints(met),           float4s(other)};
    plait_grid_solid_fill_params params{};
    put_solid_grid(params, edge_count);
    params.mesh = 1;
    params.collider_count = 1;
    params.collider_first = 2;
    params.h = 1.0f / 90;
    params.others = others ? 1 : 0;
    return setup.with(params);
}

} // namespace

// Velocities are differences of positions over a ninetieth of a second.
Case grid_solid_fill_case() {
    Case result = {PLAIT_STAGE_grid_solid_fill, {}, {{"mesh_solid", 1e-4}}, solid_unread()};
    result.unread.push_back("mesh_solid"); // is kept
    for (const uint32_t edge_count : {1u, 6u, 20u})
        for (const bool others : {false, true})
            result.setups.push_back(make(edge_count, others));
    return result;
}

} // namespace plait::cases
