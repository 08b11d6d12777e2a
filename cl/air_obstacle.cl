/* air_obstacle: how fast hair and colliders take wind away, at the nodes of the inter-hair grid.
 *
 * Items   voxels.
 * Reads   grid_density, collider.
 * Writes  air_extinction, 1/m; PLAIT_AIR_SOLID in a collider.
 * Source  Cionco 1965: in a canopy u du/dx = -C a u^2/2, so u falls as e^(-sigma x), sigma = C a/2, a
 *         the frontal area of what stands in a volume. Here that of hairs in all directions.
 */
#pragma OPENCL FP_CONTRACT OFF
#undef PLAIT_LANES
#define PLAIT_LANES 1 /* the colliders that strand models know, for a node alone */
#include "common/lane_collider.clh"
#include "common/lane_grid.clh"

static inline int is_solid(__global const float4* collider, const plait_air_obstacle_params* params,
                           float3 x) {
    const vec3 origin = vec3_of(0.0f, 0.0f, 0.0f), place = vec3_of(x.x, x.y, x.z);
    for (uint index = 0u; index < params->collider_count; ++index) {
        const uint at = params->collider_first + index;
        if (!lane_collider_meets(collider + PLAIT_COLLIDER_STRIDE * (size_t)at, x, x, 0.0f))
            continue;
        const float kind = lane_collider_kind(collider, at);
        lane_collider near = lane_collider_at(kind, collider, at);
        lane_collider_ready(kind, &near);
        if (lane_collider_gap(kind, &near, origin, place).distance < 0.0f)
            return 1;
    }
    return 0;
}

__kernel void plait_air_obstacle(const uint item_count, const plait_air_obstacle_params params,
                                 __global const float* grid_density,
                                 __global const float4* collider, __global float* air_extinction) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint n = params.edge_count;
    const lane_grid grid = lane_grid_at(params.q, params.t, params.voxel_edge, n);
    const float3 cell = (float3)((float)(item % n), (float)(item / (n * n)), (float)(item / n % n));
    const float3 along = (cell + 0.5f) * params.voxel_edge;
    const vec3 world = lane_grid_world(&grid, vec3_of(along.x, along.y, along.z));
    const float3 x = grid.corner + (float3)(world.x, world.y, world.z);
    air_extinction[item] =
        is_solid(collider, &params, x) ? PLAIT_AIR_SOLID : params.extinction * grid_density[item];
}
