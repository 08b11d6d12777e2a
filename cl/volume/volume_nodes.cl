/* volume_nodes: sums to densities and velocities, and which nodes lie inside colliders.
 *
 * Items   voxels, whose centres are the nodes.
 * Reads   grid_sum, collider, mesh_solid.
 * Writes  grid_density; grid_velocity: the mean along the grid's axes and, in w, its size;
 *         volume_rest: the mean density at rest of the hair that is there; volume_solid: the
 *         collider's velocity along the grid's axes, and 1 inside of one, else 0.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/sum.clh"
#include "contact/collider.clh"
#include "grid/grid.clh"

/* Inside of several the last counts; `mesh` of meshes. */
static inline float4 solid_at(const plait_volume_nodes_params* params, const grid_frame* grid,
                              __global const float4* collider, float4 mesh, vec3 x) {
    float4 solid = mesh;
    for (uint i = 0u; i < params->collider_count; ++i) {
        const uint index = params->collider_first + i;
        if (lane_collider_is_inward(lane_collider_kind(collider, index)) ||
            !(collider_gap(collider, index, x).distance < 0.0f))
            continue;
        const vec3 way = sub3(x, collider_carry_back(collider, index, x));
        const vec3 v = grid_components(grid, scale3(way, 1.0f / params->h));
        solid = pack3(v, 1.0f);
    }
    return solid;
}

__kernel void plait_volume_nodes(const uint item_count, const plait_volume_nodes_params params,
                                 __global const uint* grid_sum, __global const float4* collider,
                                 __global const float4* mesh_solid, __global float* grid_density,
                                 __global float4* grid_velocity, __global float* volume_rest,
                                 __global float4* volume_solid) {
    const uint voxel = get_global_id(0);
    if (voxel >= item_count)
        return;
    const uint n = params.edge_count;
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, n);
    const vec3 x = grid_centre(&grid, voxel, params.voxel_edge);
    const float4 mesh = params.meshes ? mesh_solid[voxel] : (float4)(0.0f);
    volume_solid[voxel] = solid_at(&params, &grid, collider, mesh, x);
    __global const uint* words = grid_sum + (size_t)voxel * PLAIT_SUM_STRIDE;
    const float density = convert_float(sum_read(words)) / PLAIT_SUM_DENSITY_SCALE;
    const vec3 sum = vec3_of(convert_float(sum_read(words + 2)), convert_float(sum_read(words + 4)),
                             convert_float(sum_read(words + 6)));
    const vec3 momentum = div3(sum, PLAIT_SUM_MOMENTUM_SCALE);
    const float rest = convert_float(sum_read(words + 8)) / PLAIT_SUM_REST_SCALE;
    const bool hair = density > 0.0f;
    const vec3 v = hair ? div3(momentum, density) : zero3();
    grid_density[voxel] = density;
    grid_velocity[voxel] = pack3(v, length3(v));
    volume_rest[voxel] = hair ? rest / density : 0.0f;
}
