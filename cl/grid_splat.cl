/* grid_splat: every vertex into fixed-point tent sums; no slot, no sampling.
 *
 * Items   vertices.
 * Reads   vertex_count, position, position_prev.
 * Adds to grid_sum, per voxel five 64-bit sums: tent, tent v (3), tent |v|^2; and to grid_outside.
 * Source  Petrovic et al. 2005 (trilinear transfer to grid nodes); Ugurca 2015, eq. 4.1 and 4.2,
 * for PLAIT_TENT_VOXEL. Changed sums of integers: the same bits in any order of work-items, on any
 * device whose products agree. Nodes are voxel centres; beyond the outermost ones all weight goes
 * to these. */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"
#include "common/sum.clh"

/* Velocity as far as the sums hold it; NaN, of an overflow, as 0. */
static float3 summable_velocity(const plait_grid_params* params, float3 x, float3 prev) {
    const float3 v = grid_velocity_of(params, x, prev);
    const float3 limited = clamp(v, -PLAIT_SUM_MAX_SPEED, PLAIT_SUM_MAX_SPEED);
    return select((float3)(0.0f), limited, isequal(v, v));
}

static void splat(__global uint* sums, uint voxel, float weight, float3 v) {
    __global uint* words = sums + (size_t)voxel * PLAIT_SUM_STRIDE;
    const float4 moments = sum_round(
        (float4)(weight * v * PLAIT_SUM_MOMENTUM_SCALE, weight * PLAIT_SUM_DENSITY_SCALE));
    const float4 energy = sum_round((float4)(weight * dot3(v, v) * PLAIT_SUM_ENERGY_SCALE));
    sum_add(words, convert_long(moments.w));
    sum_add(words + 2, convert_long(moments.x));
    sum_add(words + 4, convert_long(moments.y));
    sum_add(words + 6, convert_long(moments.z));
    sum_add(words + 8, convert_long(energy.x));
}

__kernel void plait_grid_splat(const uint item_count, const plait_grid_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global const float4* position_prev, __global uint* grid_sum,
                               __global uint* grid_outside) {
    const uint item = get_global_id(0);
    if (item >= item_count ||
        item % params.vertex_stride >= vertex_count[item / params.vertex_stride])
        return;
    const float3 x = position[item].xyz;
    const float3 v = summable_velocity(&params, x, position_prev[item].xyz);
    const float3 g = grid_coordinates(&params, x);
    const uint voxel = world_to_voxel(&params, g);
    if (voxel == GRID_OUTSIDE) {
        atomic_inc(grid_outside);
    } else if (params.tent == PLAIT_TENT_VOXEL) {
        splat(grid_sum, voxel, tent_voxel(g), v);
    } else {
        const stencil_t stencil = stencil_at(&params, g);
        for (uint corner = 0u; corner < 8u; ++corner)
            splat(grid_sum, stencil_voxel(stencil, corner), stencil_weight(stencil, corner), v);
    }
}
