/* grid_solid_fill: which nodes of a grid lie in a mesh that bends, and how it moves there.
 *
 * Items   rows of nodes along x.
 * Reads   collider (here the mesh), mesh_first, mesh_triangle, mesh_from, mesh_to, mesh_passed,
 *         mesh_met.
 * Moves   mesh_solid: of nodes in the mesh, the mean velocity of the corners of the triangle that was
 *         met, along the grid's axes, and 1; 0 and 1 of nodes with none beside them. Others keep what
 *         they have with params.others, else 0.
 * Source  as grid_solid_cross.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "grid/grid.clh"
#include "grid/mesh_solid.clh"

__kernel void
plait_grid_solid_fill(const uint item_count, const plait_grid_solid_fill_params params,
                      __global const float4* collider, __global const uint* mesh_first,
                      __global const uint* mesh_triangle, __global const float4* mesh_from,
                      __global const float4* mesh_to, __global const uint* mesh_passed,
                      __global const uint* mesh_met, __global float4* mesh_solid) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float no_corner[3] = {0.0f, 0.0f, 0.0f};
    const grid_frame frame = grid_at(params.q, no_corner, 1.0f, params.edge_count);
    const solid_mesh mesh = solid_mesh_at(collider, params.collider_first, mesh_first,
                                          mesh_triangle, mesh_from, mesh_to, params.mesh);
    uint inside = 0u;
    for (uint i = 0u; i < params.edge_count; ++i) {
        const uint node = item * params.edge_count + i;
        inside ^= mesh_passed[node / 32u] >> node % 32u & 1u;
        if (!inside && !params.others)
            mesh_solid[node] = (float4)(0.0f);
        if (!inside)
            continue;
        vec3 v = zero3();
        if (mesh_met[node] > 0u) {
            __global const uint* vertex = solid_corners(&mesh, mesh_met[node] - 1u);
            const vec3 ways = add3(add3(solid_way(&mesh, vertex[0]), solid_way(&mesh, vertex[1])),
                                   solid_way(&mesh, vertex[2]));
            v = grid_components(&frame, scale3(ways, 1.0f / (3.0f * params.h)));
        }
        mesh_solid[node] = pack3(v, 1.0f);
    }
}
