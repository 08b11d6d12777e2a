/* grid_velocity: tent-weighted mean velocity of the vertices in a voxel's slots.
 *
 * Items   voxels, one work-group of any size each.
 * Reads   grid_slot, position, position_prev, grid_density.
 * Writes  grid_velocity: mean along the grid's axes and, in w, the root mean square speed.
 * Source  Ugurca 2015, eq. 4.2: V = sum tent v / D, v by Verlet history.
 * Changed an empty voxel has velocity 0 instead of 0/0; the rms speed, for the floored rule.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/reduce.clh"
#include "grid/grid.clh"

/* (tent v, tent |v|^2) of a vertex. */
static inline float4 weighted_velocity(const grid_frame* grid, float h, vec3 x, vec3 prev) {
    const float tent = grid_tents(grid_coordinates(grid, x));
    const vec3 v = grid_verlet_velocity(grid, h, x, prev);
    return pack3(scale3(v, tent), tent * dot3(v, v));
}

static inline float4 mean_and_rms(float4 sum, float density) {
    if (!(density > 0.0f))
        return (float4)(0.0f);
    return (float4)(sum.xyz / density, sqrt(sum.w / density));
}

__kernel void plait_grid_velocity(const uint item_count, const plait_grid_params params,
                                  __global const uint* grid_slot, __global const float4* position,
                                  __global const float4* position_prev,
                                  __global const float* grid_density,
                                  __global float4* grid_velocity, __local float4* partial) {
    const uint voxel = get_group_id(0);
    const uint item = get_local_id(0);
    const float density = voxel < item_count ? grid_density[voxel] : 0.0f;
    const uint end = density > 0.0f ? params.capacity : 0u; /* most voxels hold no hair */
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    float4 sum = (float4)(0.0f);
    for (uint slot = item; slot < end; slot += (uint)get_local_size(0)) {
        const uint vertex = grid_slot[(size_t)voxel * params.capacity + slot];
        if (vertex != PLAIT_SLOT_EMPTY)
            sum += weighted_velocity(&grid, params.h, unpack3(position[vertex]),
                                     unpack3(position_prev[vertex]));
    }
    partial[item] = sum;
    reduce_float4(partial);
    if (item == 0u && voxel < item_count)
        grid_velocity[voxel] = mean_and_rms(partial[0], density);
}
