#include "grid/solid_inputs.hpp"
#include "mesh/field_inputs.hpp"

namespace plait::cases {
namespace {

Setup make(uint32_t edge_count, uint32_t count) {
    FieldMeshes meshes;
    Random random(91 + count);
    add_solid_row(meshes.rows, random, {0, 0}); // of the substep before
    for (uint32_t i = 0; i < count; ++i) {
        meshes.add(random);
        add_solid_row(meshes.rows, random, {0, 0});
    }
    Setup setup;
    setup.name =
        std::to_string(edge_count) + " nodes along an edge, " + std::to_string(count) + " meshes";
    setup.items = edge_count * edge_count;
    setup.buffers = {float4s(meshes.rows), float4s(meshes.grid), uints(meshes.nodes),
                     floats(meshes.values), unwritten_float4s(setup.items * edge_count)};
    plait_grid_solid_field_params params{};
    put_solid_grid(params, edge_count);
    params.collider_count = count;
    params.collider_first = 1;
    params.h = 1.0f / 90;
    return setup.with(params);
}

} // namespace

// Velocities are differences of positions over a ninetieth of a second. No node lies so near a surface
// that rounding decides on which side.
Case grid_solid_field_case() {
    Case result = {PLAIT_STAGE_grid_solid_field, {}, {{"mesh_solid", 1e-4}}, solid_unread()};
    for (const char* share : {"collider.begin.a.radius", "collider.end.a.radius"})
        result.unread.push_back(share);
    result.decides = {"mesh_values"}; // by where they are 0, which a hundredth of them is not
    for (const uint32_t edge_count : {1u, 5u, 20u, 33u})
        for (const uint32_t count : {1u, 3u})
            result.setups.push_back(make(edge_count, count));
    return result;
}

} // namespace plait::cases
