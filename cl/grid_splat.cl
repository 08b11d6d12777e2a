/* grid_splat: every vertex into fixed-point tent sums; no slot, no sampling.
 *
 * Items   strands.
 * Reads   vertex_count, position, position_prev.
 * Adds to grid_sum, per voxel five 64-bit sums: tent, tent v (3), tent |v|^2; and to grid_outside.
 * Source  Petrovic et al. 2005 (trilinear transfer to grid nodes); Ugurca 2015, eq. 4.1 and 4.2,
 *         for PLAIT_TENT_VOXEL.
 * Changed sums of integers: the same bits in any order of strands, on any device whose products
 *         agree. Nodes are voxel centres; beyond the outermost ones all weight goes to these.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"
#include "common/group_sum.clh"

/* Velocity as far as the sums hold it; NaN, of an overflow, as 0. */
static inline float3 summable_velocity(const plait_grid_params* params, float3 x, float3 prev) {
    const float3 v = grid_velocity_of(params, x, prev);
    const float3 limited = clamp(v, -PLAIT_SUM_MAX_SPEED, PLAIT_SUM_MAX_SPEED);
    return select((float3)(0.0f), limited, isequal(v, v));
}

/* What a run of vertices adds to the nodes of the cell they share, added up in the strand's order
 * and rounded once: hair passes through a cell with several vertices, and an addition in private
 * memory costs a hundredth of an atomic one. */
#define SPLAT_NODES 8

typedef struct run_t {
    stencil_t cell;              /* low is the voxel itself with PLAIT_TENT_VOXEL */
    float4 moments[SPLAT_NODES]; /* tent v (xyz), tent */
    float energy[SPLAT_NODES];   /* tent |v|^2 */
} run_t;

static inline void run_begin(run_t* run, stencil_t cell, uint nodes) {
    run->cell = cell;
#pragma unroll
    for (uint node = 0u; node < nodes; ++node) {
        run->moments[node] = (float4)(0.0f);
        run->energy[node] = 0.0f;
    }
}

static inline void run_add(run_t* run, uint node, float weight, float3 v) {
    run->moments[node] += weight * (float4)(v, 1.0f);
    run->energy[node] += weight * dot3(v, v);
}

SUMS_INLINE void run_end(const run_t* run, uint nodes, SUM_SPACE uint* sums) {
    if (run->cell.low == GRID_OUTSIDE)
        return;
    const float4 scale = (float4)((float3)(PLAIT_SUM_MOMENTUM_SCALE), PLAIT_SUM_DENSITY_SCALE);
#pragma unroll
    for (uint node = 0u; node < nodes; ++node) {
        splat_add(sums + (size_t)stencil_voxel(run->cell, node) * PLAIT_SUM_STRIDE,
                  scale * run->moments[node], PLAIT_SUM_ENERGY_SCALE * run->energy[node]);
    }
}

/* The cell of a vertex; its `low` is GRID_OUTSIDE outside the grid. */
static inline stencil_t cell_of(const plait_grid_params* params, float3 g) {
    stencil_t cell = {GRID_OUTSIDE, (uint3)(0u), (float3)(0.0f)};
    const uint voxel = world_to_voxel(params, g);
    if (voxel == GRID_OUTSIDE)
        return cell;
    if (params->tent == PLAIT_TENT_TRILINEAR)
        return stencil_at(params, g);
    cell.low = voxel;
    return cell;
}

/* Adds all vertices of a strand to so many nodes each; returns how many lie outside the grid. Where
 * `nodes` is a constant, the run stays in registers. */
SUMS_INLINE uint splat_strand(const plait_grid_params* params, uint count, uint nodes,
                              __global const float4* position, __global const float4* position_prev,
                              SUM_SPACE uint* sums) {
    uint outside = 0u;
    run_t run;
    run.cell.low = GRID_OUTSIDE;
    for (uint i = 0u; i < count; ++i) {
        const float3 x = position[i].xyz;
        const float3 g = grid_coordinates(params, x);
        const stencil_t cell = cell_of(params, g);
        if (cell.low != run.cell.low) {
            run_end(&run, nodes, sums);
            run_begin(&run, cell, nodes);
        }
        if (cell.low == GRID_OUTSIDE) {
            ++outside;
            continue;
        }
        const float3 v = summable_velocity(params, x, position_prev[i].xyz);
#pragma unroll
        for (uint node = 0u; node < nodes; ++node)
            run_add(&run, node, nodes == 1u ? tent_voxel(g) : stencil_weight(cell, node), v);
    }
    run_end(&run, nodes, sums);
    return outside;
}

__kernel void plait_grid_splat(const uint item_count, const plait_grid_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global const float4* position_prev, __global uint* grid_sum,
                               __global uint* grid_outside) {
    const uint strand = get_global_id(0);
    SUMS_BEGIN(sums, grid_sum);
    uint outside = 0u;
    if (strand < item_count) {
        const size_t first = (size_t)strand * params.vertex_stride;
        const uint count = vertex_count[strand];
        outside =
            params.tent == PLAIT_TENT_VOXEL
                ? splat_strand(&params, count, 1u, position + first, position_prev + first, sums)
                : splat_strand(&params, count, SPLAT_NODES, position + first, position_prev + first,
                               sums);
    }
    SUMS_END(sums, grid_sum);
    if (outside > 0u)
        atomic_add(grid_outside, outside);
}
