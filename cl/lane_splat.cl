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
#include "common/lane_grid.clh"
#include "common/sum.clh"

/* Voxels that a work-item holds at once: blocks of 4 x 4 x 4 have a place for each. */
#define SPLAT_HELD 64
#define SPLAT_NONE 0xffffffffu

typedef struct {
    uint voxel[SPLAT_HELD];
    float8 moments[SPLAT_HELD]; /* tent v (xyz), tent, tent |v|^2 */
} splat_t;

static inline void splat_flush(const splat_t* splat, uint held, __global uint* sums) {
    const float8 moments = splat->moments[held];
    const float4 scale = (float4)((float3)(PLAIT_SUM_MOMENTUM_SCALE), PLAIT_SUM_DENSITY_SCALE);
    const float4 first = sum_round(scale * moments.lo);
    const float4 energy = sum_round((float4)(PLAIT_SUM_ENERGY_SCALE * moments.s4));
    __global uint* words = sums + (size_t)splat->voxel[held] * PLAIT_SUM_STRIDE;
    sum_add(words, convert_long(first.w));
    sum_add(words + 2, convert_long(first.x));
    sum_add(words + 4, convert_long(first.y));
    sum_add(words + 6, convert_long(first.z));
    sum_add(words + 8, convert_long(energy.x));
}

static inline void splat_add(splat_t* splat, uint voxel, uint held, float8 moments,
                             __global uint* sums) {
    if (splat->voxel[held] != voxel) {
        if (splat->voxel[held] != SPLAT_NONE)
            splat_flush(splat, held, sums);
        splat->voxel[held] = voxel;
        splat->moments[held] = (float8)(0.0f);
    }
    splat->moments[held] += moments;
}

/* A vertex' share in the eight voxels around it. */
static inline void splat_corners(splat_t* splat, const lane_grid* grid, uint3 cell, float3 high,
                                 float8 moments, __global uint* sums) {
    const uint n = (uint)grid->count;
    for (uint corner = 0u; corner < (n > 1u ? 8u : 1u); ++corner) {
        const uint3 at = cell + (uint3)(corner & 1u, corner >> 1 & 1u, corner >> 2);
        const float x = corner & 1u ? high.x : 1.0f - high.x;
        const float y = corner & 2u ? high.y : 1.0f - high.y;
        const float z = corner & 4u ? high.z : 1.0f - high.z;
        splat_add(splat, (at.y * n + at.z) * n + at.x,
                  (at.x & 3u) | (at.y & 3u) << 2 | (at.z & 3u) << 4, moments * (x * y * z), sums);
    }
}

/* NaN, of an overflow, as 0. */
static inline real summable(real v) {
    const real most = (real)(PLAIT_SUM_MAX_SPEED);
    return pick(v == v, clamp(v, -most, most), (real)(0.0f));
}

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
    for (uint held = 0; held < SPLAT_HELD; ++held)
        splat.voxel[held] = SPLAT_NONE;
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
                splat_add(&splat, (at.y * params.edge_count + at.z) * params.edge_count + at.x,
                          (at.x & 3u) | (at.y & 3u) << 2 | (at.z & 3u) << 4, moments * high.x,
                          grid_sum);
            else
                splat_corners(&splat, &grid, at, high, moments, grid_sum);
        }
    }
    for (uint held = 0; held < SPLAT_HELD; ++held)
        if (splat.voxel[held] != SPLAT_NONE)
            splat_flush(&splat, held, grid_sum);
    if (outside > 0u)
        atomic_add(grid_outside, outside);
}
