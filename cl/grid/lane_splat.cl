/* lane_splat: grid_splat from the lanes, without the way over positions in strand order.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Adds to grid_sum, per voxel five 64-bit sums: tent, tent v (3), tent |v|^2; and to grid_outside.
 * Source  as grid_splat.
 * Changed neighbouring strands pass through the same voxels: what a work-item adds to one is added
 *         up and rounded once, on CPUs in private memory, in the order of rows and then lanes; on GPUs
 *         as long as vertices lie among the same eight, and groups add up small grids in local memory
 *         first. Strands lie in lanes by their roots, so the sums do not depend on the order in which
 *         work-items arrive. With `each` vertices are rounded one by one, as where each strand is a
 *         work-item: strands may be added up elsewhere.
 */
#pragma OPENCL FP_CONTRACT OFF
#define SPLAT_LAST_SCALE PLAIT_SUM_ENERGY_SCALE
#include "grid/lane_sum.clh"
#if PLAIT_LANES > 1
#include "grid/lane_sum_whole.clh"
#endif

/* All that a work-item adds; returns how many vertices lie outside the grid. */
SUMS_INLINE uint splat_item(uint item_count, const plait_lane_grid_params* params,
                            __global const uint* lane_strand, __global const uint* vertex_count,
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
    uint outside = 0u;
    for (int i = 0; i < (int)params->vertex_stride; ++i)
        for (uint j = 0; j < taken; ++j) {
            const splat_row row = splat_row_of(&grid, strands + j, i, params->tent, lane_x, lane_v);
            outside += splat_outside(&row);
            const splat_share share = {row.v, (real)(1.0f), dot3(row.v, row.v)};
            splat_vertices(&splat, &grid, &row, params->tent, &share, sums);
        }
    splat_end(&splat, &grid, sums);
    return outside;
}

#if PLAIT_LANES > 1
/* The same, each vertex rounded by itself. */
static inline uint splat_each_item(uint item_count, const plait_lane_grid_params* params,
                                   __global const uint* lane_strand,
                                   __global const uint* vertex_count, __global const real* lane_x,
                                   __global const real* lane_v, __global uint* sums) {
    splat_strands strands[SPLAT_RUN];
    const uint taken =
        splat_take(strands, (uint)get_global_id(0), item_count, lane_strand, vertex_count, lane_x);
    if (taken == 0u)
        return 0u;
    const grid_frame grid = grid_at(params->q, params->t, params->voxel_edge, params->edge_count);
    splat_whole_t splat;
    splat_whole_begin(&splat);
    uint outside = 0u;
    for (int i = 0; i < (int)params->vertex_stride; ++i)
        for (uint j = 0; j < taken; ++j) {
            const splat_row row = splat_row_of(&grid, strands + j, i, params->tent, lane_x, lane_v);
            outside += splat_outside(&row);
            splat_whole_vertices(&splat, &grid, &row, params->tent, sums);
        }
    splat_whole_end(&splat, sums);
    return outside;
}
#endif

__kernel PLAIT_WIDE void plait_lane_splat(const uint item_count,
                                          const plait_lane_grid_params params,
                                          __global const uint* lane_strand,
                                          __global const uint* vertex_count,
                                          __global const real* lane_x, __global const real* lane_v,
                                          __global uint* grid_sum, __global uint* grid_outside) {
    SUMS_BEGIN(sums, grid_sum);
    uint outside;
#if PLAIT_LANES > 1
    if (params.each)
        outside =
            splat_each_item(item_count, &params, lane_strand, vertex_count, lane_x, lane_v, sums);
    else
#endif
        outside = splat_item(item_count, &params, lane_strand, vertex_count, lane_x, lane_v, sums);
    SUMS_END(sums, grid_sum);
    if (outside > 0u)
        atomic_add(grid_outside, outside);
}
