#include "core/grid/mesh_solid.hpp"

#include "core/mesh/bending_meshes.hpp"
#include "core/mesh/mesh_colliders.hpp"

#include <algorithm>

namespace plait {
namespace {

template <typename Params> void put_grid(Params& params, const NodeGridPlace& grid) {
    params.edge_count = grid.edge_count;
    std::ranges::copy(grid.q, params.q);
    if constexpr (requires { params.voxel_edge; }) {
        params.voxel_edge = grid.voxel_edge;
        std::ranges::copy(grid.t, params.t);
    }
}

} // namespace

Result<MeshSolid> MeshSolid::create(Device& device, uint32_t edge_count) {
    MeshSolid made;
    const size_t nodes = size_t{edge_count} * edge_count * edge_count;
    PLAIT_TRY(device.create(made.solid_, PLAIT_ELEMENT_FLOAT4, nodes, "mesh_solid"));
    PLAIT_TRY(device.create(made.passed_, PLAIT_ELEMENT_UINT, (nodes + 31) / 32, "mesh_passed"));
    PLAIT_TRY(device.create(made.met_, PLAIT_ELEMENT_UINT, nodes, "mesh_met"));
    return made;
}

const Buffer* MeshSolid::append(Schedule& schedule, const NodeGridPlace& grid, const Bodies& bodies,
                                float h) const {
    bool any = false;
    if (const MeshBuffers* const m = bodies.field_buffers) {
        plait_grid_solid_field_params params{};
        put_grid(params, grid);
        params.collider_count = bodies.fields.count;
        params.collider_first = bodies.fields.first;
        params.h = h;
        schedule.add(PLAIT_STAGE_grid_solid_field, grid.edge_count * grid.edge_count, params,
                     {&bodies.fields.buffer, &m->fields->grid, &m->fields->nodes,
                      &m->fields->values, &solid_});
        any = true;
    }
    for (uint32_t mesh = 0; mesh < bodies.nearest.count; ++mesh)
        if (bodies.nearest_buffers->surfaces->insides[mesh] > 0) {
            append_bending(schedule, grid, bodies, h, mesh, any);
            any = true;
        }
    return any ? &solid_ : nullptr;
}

void MeshSolid::append_bending(Schedule& schedule, const NodeGridPlace& grid, const Bodies& bodies,
                               float h, uint32_t mesh, bool others) const {
    const BendingBuffers& b = *bodies.nearest_buffers;
    const SurfaceGeometry& g = *b.surfaces;
    for (const Buffer* words : {&passed_, &met_})
        schedule.add(PLAIT_STAGE_grid_clear, static_cast<uint32_t>(words->count()),
                     plait_grid_clear_params{0}, {words});
    const uint32_t row = bodies.nearest.first + mesh;
    plait_grid_solid_cross_params cross{};
    put_grid(cross, grid);
    cross.mesh = mesh;
    cross.collider_count = 1;
    cross.collider_first = row;
    schedule.add(PLAIT_STAGE_grid_solid_cross, g.insides[mesh], cross,
                 {&bodies.nearest.buffer, &g.first, &g.triangle, &b.from, &b.to, &passed_, &met_});
    plait_grid_solid_fill_params fill{};
    put_grid(fill, grid);
    fill.mesh = mesh;
    fill.collider_count = 1;
    fill.collider_first = row;
    fill.h = h;
    fill.others = others ? 1 : 0;
    schedule.add(
        PLAIT_STAGE_grid_solid_fill, grid.edge_count * grid.edge_count, fill,
        {&bodies.nearest.buffer, &g.first, &g.triangle, &b.from, &b.to, &passed_, &met_, &solid_});
}

} // namespace plait
