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
#include "base/group_sum.clh"
#include "grid/grid.clh"

/* What a run of vertices adds to the nodes of the cell they share, added up in the strand's order
 * and rounded once: hair passes through a cell with several vertices, and an addition in private
 * memory costs a hundredth of an atomic one. */
#define SPLAT_NODES 8
#define NO_VOXEL 0xffffffffu /* of those outside the grid */

typedef struct run_t {
    uint voxel;                  /* the least of the eight, or with PLAIT_TENT_VOXEL the one */
    float4 moments[SPLAT_NODES]; /* tent v (xyz), tent */
    float energy[SPLAT_NODES];   /* tent |v|^2 */
} run_t;

static inline void run_begin(run_t* run, uint voxel, uint nodes) {
    run->voxel = voxel;
#pragma unroll
    for (uint node = 0u; node < nodes; ++node) {
        run->moments[node] = (float4)(0.0f);
        run->energy[node] = 0.0f;
    }
}

static inline void run_add(run_t* run, uint node, float weight, vec3 v) {
    run->moments[node] += weight * pack3(v, 1.0f);
    run->energy[node] += weight * dot3(v, v);
}

SUMS_INLINE void run_end(const run_t* run, const grid_frame* grid, uint nodes,
                         SUM_SPACE uint* sums) {
    if (run->voxel == NO_VOXEL)
        return;
    const float4 scale = (float4)((float3)(PLAIT_SUM_MOMENTUM_SCALE), PLAIT_SUM_DENSITY_SCALE);
#pragma unroll
    for (uint node = 0u; node < nodes; ++node) {
        splat_add(sums + (size_t)(run->voxel + grid_corner(grid, node)) * PLAIT_SUM_STRIDE,
                  scale * run->moments[node], PLAIT_SUM_ENERGY_SCALE * run->energy[node]);
    }
}

/* Adds all vertices of a strand to so many nodes each; returns how many lie outside the grid. Where
 * `nodes` is a constant, the run stays in registers. */
SUMS_INLINE uint splat_strand(const plait_grid_params* params, uint count, uint nodes,
                              __global const float4* position, __global const float4* position_prev,
                              SUM_SPACE uint* sums) {
    const grid_frame grid = grid_at(params->q, params->t, params->voxel_edge, params->edge_count);
    uint outside = 0u;
    run_t run;
    run.voxel = NO_VOXEL;
    for (uint i = 0u; i < count; ++i) {
        const vec3 x = unpack3(position[i]), g = grid_coordinates(&grid, x);
        const mask inside = grid_contains(&grid, g);
        const grid_cell cell =
            grid_cell_of(&grid, g, inside, nodes == 1u ? PLAIT_TENT_VOXEL : PLAIT_TENT_TRILINEAR);
        const uint voxel = inside ? (uint)grid_voxel_of(&grid, cell) : NO_VOXEL;
        if (voxel != run.voxel) {
            run_end(&run, &grid, nodes, sums);
            run_begin(&run, voxel, nodes);
        }
        if (!inside) {
            ++outside;
            continue;
        }
        const vec3 v =
            summable3(grid_verlet_velocity(&grid, params->h, x, unpack3(position_prev[i])));
        const grid_weights weights = grid_weights_of(&cell);
#pragma unroll
        for (uint node = 0u; node < nodes; ++node)
            run_add(&run, node, nodes == 1u ? cell.high.x : weights.of[node], v);
    }
    run_end(&run, &grid, nodes, sums);
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
