#include "grid/solid_inputs.hpp"

namespace plait::cases {
namespace {

Setup make(uint32_t edge_count, bool bends) {
    NearestMeshes meshes;
    Random random(edge_count + 7);
    add_ball(meshes, random, false, !bends); // another, before it
    add_ball(meshes, random, false, bends);
    for (int i = 0; i < 3; ++i) // of the substep before, and of that one
        add_solid_row(meshes.rows, random, {0.2, 0.6});
    const uint32_t nodes = edge_count * edge_count * edge_count;
    Setup setup;
    setup.name = std::to_string(edge_count) + " nodes along an edge" + (bends ? ", it bends" : "");
    setup.items = meshes.first[PLAIT_MESH_FIRST_STRIDE + PLAIT_MESH_FIRST_COUNT];
    setup.buffers = {float4s(meshes.rows),
                     uints(meshes.first),
                     uints(meshes.triangle),
                     float4s(meshes.from),
                     float4s(meshes.to),
                     uints(std::vector<uint32_t>((nodes + 31) / 32, 0u)),
                     uints(std::vector<uint32_t>(nodes, 0u))};
    plait_grid_solid_cross_params params{};
    put_solid_grid(params, edge_count);
    params.mesh = 1;
    params.collider_count = 1;
    params.collider_first = 2;
    return setup.with(params);
}

} // namespace

// No line of nodes passes so near an edge of a triangle, and no triangle so near a node, that rounding
// decides.
Case grid_solid_cross_case() {
    Case result = {PLAIT_STAGE_grid_solid_cross, {}, {}, solid_unread()};
    for (const char* begin : {"collider.begin.a", "collider.begin.a.radius", "collider.turn"})
        result.unread.push_back(begin);
    for (const uint32_t edge_count : {1u, 6u, 20u, 35u})
        for (const bool bends : {false, true})
            result.setups.push_back(make(edge_count, bends));
    return result;
}

} // namespace plait::cases
