/* grid_solid_field: which nodes of a grid lie in meshes of form FIELD, and how these move there.
 *
 * Items   rows of nodes along x.
 * Reads   collider (here these meshes), mesh_grid, mesh_nodes, mesh_values.
 * Writes  mesh_solid: the mesh's velocity along the grid's axes, and 1 inside of one, else 0.
 * Source  distances as in mesh_field; nodes passed over as Hart 1996 passes over empty space: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "contact/collider.clh"
#include "grid/grid.clh"
#include "mesh/mesh_field.clh"

typedef struct {
    mesh_field field;
    mesh_motion motion;
    uint row; /* in `collider` */
} solid_body;

/* Nodes behind one at `distance` that surely lie on the same side. No distance changes by more than the
 * way; what is read between nodes of the field is off by less than a cell, here and there. */
static inline uint solid_alike(const solid_body* body, float distance, float voxel_edge) {
    const float way = fabs(distance) - 2.0f * body->field.edge;
    return way > 0.0f ? (uint)fmin(way / voxel_edge, 4096.0f) : 0u;
}

static inline void solid_row(const plait_grid_solid_field_params* params, const grid_frame* grid,
                             const solid_body* body, __global const float4* collider, uint first,
                             __global float4* mesh_solid) {
    const uint n = params->edge_count;
    for (uint i = 0u; i < n;) {
        const vec3 x = grid_centre(grid, first + i, params->voxel_edge);
        mesh_cells cells;
        const float distance =
            mesh_field_first_sample(&body->field, mesh_own(&body->motion, x), &cells).distance;
        const uint alike = solid_alike(body, distance, params->voxel_edge);
        const uint end = min(i + 1u + alike, n);
        for (uint node = i; distance < 0.0f && node < end; ++node) {
            const vec3 at = grid_centre(grid, first + node, params->voxel_edge);
            const vec3 way = sub3(at, collider_carry_back(collider, body->row, at));
            mesh_solid[first + node] =
                pack3(grid_components(grid, scale3(way, 1.0f / params->h)), 1.0f);
        }
        i = end;
    }
}

__kernel void
plait_grid_solid_field(const uint item_count, const plait_grid_solid_field_params params,
                       __global const float4* collider, __global const float4* mesh_grid,
                       __global const uint* mesh_nodes, __global const float* mesh_values,
                       __global float4* mesh_solid) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint n = params.edge_count, first = item * n;
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, n);
    for (uint i = 0u; i < n; ++i)
        mesh_solid[first + i] = (float4)(0.0f);
    for (uint mesh = 0u; mesh < params.collider_count; ++mesh) {
        const uint row = params.collider_first + mesh;
        const solid_body body = {mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh),
                                 mesh_motion_at(collider, row), row};
        solid_row(&params, &grid, &body, collider, first, mesh_solid);
    }
}
