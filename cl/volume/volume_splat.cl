/* volume_splat: hair, its momentum and its density at rest into fixed-point sums at grid nodes.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, strand_wetness, lane_share, lane_x, lane_v.
 * Adds to grid_sum, per voxel five 64-bit sums, a the hair that a vertex stands for, d its density
 *         at rest: tent a, tent a v (3), tent a d; and to grid_outside. Of hair of wetness w d is
 *         (1 + 2 w) times as much; with params.soaked the fifth sum is tent a w.
 * Source  as grid_splat; the density that hair had travels with it: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#define SPLAT_LAST_SCALE PLAIT_SUM_REST_SCALE
#include "grid/lane_sum.clh"
#include "plait/constants.h"

/* Wetness of the strands in the lanes of a work-item. */
static inline real wetness_of(__global const uint* lane_strand, lane_place place, uint strands,
                              __global const float* strand_wetness) {
    const lane_strands of = lane_strands_of(lane_strand, place, strands);
    real wetness;
    for (uint k = 0; k < PLAIT_LANES; ++k)
        LANE(wetness, k) = strand_wetness[of.at[k]];
    return wetness;
}

/* All that a work-item adds; returns how many vertices lie outside the grid. */
SUMS_INLINE uint splat_item(uint item_count, const plait_lane_volume_params* params,
                            __global const uint* lane_strand, __global const uint* vertex_count,
                            __global const float* strand_wetness, __global const real* lane_share,
                            __global const real* lane_x, __global const real* lane_v,
                            SUM_SPACE uint* sums) {
    splat_strands strands[SPLAT_RUN];
    const uint taken =
        splat_take(strands, (uint)get_global_id(0), item_count, lane_strand, vertex_count, lane_x);
    if (taken == 0u)
        return 0u;
    const grid_frame grid = grid_at(params->q, params->t, params->voxel_edge, params->edge_count);
    splat_t splat;
    splat_begin(&splat);
    real wetness[SPLAT_RUN];
    for (uint j = 0; j < taken; ++j)
        wetness[j] = params->wet
                         ? wetness_of(lane_strand, strands[j].place, item_count, strand_wetness)
                         : (real)(0.0f);
    uint outside = 0u;
    for (int i = 0; i < (int)params->vertex_stride; ++i)
        for (uint j = 0; j < taken; ++j) {
            const splat_row row =
                splat_row_of(&grid, strands + j, i, PLAIT_TENT_TRILINEAR, lane_x, lane_v);
            lane_fetch(lane_share, strands[j].place, PLAIT_LANE_SHARE_COMPONENTS, (size_t)i + 1u);
            const real hair = lane_share[lane_index(strands[j].place, PLAIT_LANE_SHARE_COMPONENTS,
                                                    (size_t)i, PLAIT_LANE_SHARE_HAIR)];
            real rest = lane_share[lane_index(strands[j].place, PLAIT_LANE_SHARE_COMPONENTS,
                                              (size_t)i, PLAIT_LANE_SHARE_REST)];
            if (params->wet)
                rest =
                    params->soaked ? wetness[j] : rest * (1.0f + PLAIT_WET_CLOSENESS * wetness[j]);
            outside += splat_outside(&row);
            const splat_share share = {scale3(row.v, hair), hair, hair * rest};
            splat_vertices(&splat, &grid, &row, PLAIT_TENT_TRILINEAR, &share, sums);
        }
    splat_end(&splat, &grid, sums);
    return outside;
}

__kernel PLAIT_WIDE void
plait_volume_splat(const uint item_count, const plait_lane_volume_params params,
                   __global const uint* lane_strand, __global const uint* vertex_count,
                   __global const float* strand_wetness, __global const real* lane_share,
                   __global const real* lane_x, __global const real* lane_v,
                   __global uint* grid_sum, __global uint* grid_outside) {
    SUMS_BEGIN(sums, grid_sum);
    const uint outside = splat_item(item_count, &params, lane_strand, vertex_count, strand_wetness,
                                    lane_share, lane_x, lane_v, sums);
    SUMS_END(sums, grid_sum);
    if (outside > 0u)
        atomic_add(grid_outside, outside);
}
