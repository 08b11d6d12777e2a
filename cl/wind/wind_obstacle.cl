/* wind_obstacle: how fast hair and colliders take wind away, at the nodes of a grid around the
 * groom.
 *
 * Items   voxels.
 * Reads   grid_density, collider, mesh_solid.
 * Writes  wind_extinction, 1/m; PLAIT_AIR_SOLID in a collider or mesh.
 * Source  Cionco 1965: in a canopy u du/dx = -C a u^2/2, so u falls as e^(-sigma x), sigma = C a/2, a
 *         the frontal area of what stands in a volume. Here that of hairs in all directions.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "contact/collider.clh"
#include "grid/grid.clh"

static inline int is_solid(__global const float4* collider,
                           const plait_wind_obstacle_params* params, vec3 x) {
    for (uint index = 0u; index < params->collider_count; ++index)
        if (!lane_collider_is_inward(
                lane_collider_kind(collider, params->collider_first + index)) &&
            collider_gap(collider, params->collider_first + index, x).distance < 0.0f)
            return 1;
    return 0;
}

__kernel void plait_wind_obstacle(const uint item_count, const plait_wind_obstacle_params params,
                                  __global const float* grid_density,
                                  __global const float4* collider,
                                  __global const float4* mesh_solid,
                                  __global float* wind_extinction) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint n = params.edge_count;
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, n);
    const vec3 x = grid_centre(&grid, item, params.voxel_edge);
    const int solid =
        (params.meshes && mesh_solid[item].w > 0.0f) || is_solid(collider, &params, x);
    wind_extinction[item] = solid ? PLAIT_AIR_SOLID : params.extinction * grid_density[item];
}
