/* lane_splat: grid_splat from the lanes, without the way over positions in strand order.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Adds to grid_sum, per voxel five 64-bit sums: tent, tent v (3), tent |v|^2; and to grid_outside.
 * Source  as grid_splat.
 * Changed neighbouring strands pass through the same voxels: what a work-item adds to one is added
 *         up in private memory, in the order of rows and then lanes, and rounded once. Strands lie
 *         in lanes by their roots, so the sums do not depend on the order in which work-items
 *         arrive.
 */
#pragma OPENCL FP_CONTRACT OFF
#define SPLAT_LAST_SCALE PLAIT_SUM_ENERGY_SCALE
#include "common/lane_sum.clh"

__kernel void plait_lane_splat(const uint item_count, const plait_lane_grid_params params,
                               __global const uint* lane_strand, __global const uint* vertex_count,
                               __global const real* lane_x, __global const real* lane_v,
                               __global uint* grid_sum, __global uint* grid_outside) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const uint lanes = lane_place_strands(place, item_count);
    const lane_grid grid = lane_grid_of(&params);
    const vec3 root = load3(lane_x, place, 0);
    splat_t splat;
    splat_begin(&splat);
    uint outside = 0u;
    for (int i = 0; i < (int)params.vertex_stride; ++i) {
        const vec3 x = i > 0 ? add3(root, load3(lane_x, place, i)) : root;
        vec3 v = lane_grid_components(&grid, load3(lane_v, place, i));
        v = vec3_of(summable(v.x), summable(v.y), summable(v.z));
        const vec3 g = lane_grid_coordinates(&grid, x);
        const mask there = (mask)(i) < counts, inside = lane_grid_contains(&grid, g);
        const lane_cell cell = lane_cell_of(&grid, g, inside, params.tent);
        for (uint k = 0; k < lanes; ++k) {
            if (!LANE_OF_MASK(there, k))
                continue;
            if (!LANE_OF_MASK(inside, k)) {
                ++outside;
                continue;
            }
            const float3 u = (float3)(LANE(v.x, k), LANE(v.y, k), LANE(v.z, k));
            const float energy = u.x * u.x + u.y * u.y + u.z * u.z;
            const float8 moments = (float8)(u, 1.0f, energy, (float3)(0.0f));
            const uint3 at =
                (uint3)(LANE_OF_MASK(cell.x, k), LANE_OF_MASK(cell.y, k), LANE_OF_MASK(cell.z, k));
            const float3 high =
                (float3)(LANE(cell.high.x, k), LANE(cell.high.y, k), LANE(cell.high.z, k));
            if (params.tent == PLAIT_TENT_VOXEL)
                splat_add(&splat, &grid, at, moments * high.x, grid_sum);
            else
                splat_corners(&splat, &grid, at, high, moments, grid_sum);
        }
    }
    splat_end(&splat, grid_sum);
    if (outside > 0u)
        atomic_add(grid_outside, outside);
}
