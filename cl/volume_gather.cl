/* volume_gather: what pressure and viscosity do at nodes, to vertices.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, volume_pull.
 * Moves   lane_v, with BDF2 lane_v_before by as much; never of a root.
 * Writes  lane_pressure: the acceleration by pressure, in the world, for the step to come; 0 of a
 *         root, past the tip and outside the grid.
 * Source  a vertex keeps its own velocity and takes the nodes' change of it: Brackbill & Ruppel
 *         1986 (FLIP); a share of the nodes' velocity, which is in their change, takes the place of
 *         as much of its own.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"
#include "common/lane_step.clh"

/* Along the grid's axes. */
typedef struct {
    vec3 change; /* m/s */
    real share;  /* of the vertex' own velocity that goes */
    vec3 push;   /* m/s^2 */
} node_pull;

static inline node_pull pull_at(const grid_frame* grid, grid_cell cell,
                                __global const float4* volume_pull) {
    node_pull at;
    const mask low = grid_voxel_of(grid, cell);
    const grid_weights weights = grid_weights_of(&cell);
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        float8 pull = (float8)(0.0f); /* both at once: they lie together */
#pragma unroll
        for (uint corner = 0u; corner < 8u; ++corner) {
            const uint node = (uint)LANE_OF_MASK(low, k) + grid_corner(grid, corner);
            const float weight = LANE(weights.of[corner], k);
            pull += weight * vload8(node, (__global const float*)volume_pull);
        }
        LANE(at.change.x, k) = pull.s0;
        LANE(at.change.y, k) = pull.s1;
        LANE(at.change.z, k) = pull.s2;
        LANE(at.share, k) = pull.s3;
        LANE(at.push.x, k) = pull.s4;
        LANE(at.push.y, k) = pull.s5;
        LANE(at.push.z, k) = pull.s6;
    }
    return at;
}

__kernel void plait_volume_gather(const uint item_count, const plait_lane_volume_params params,
                                  __global const uint* lane_strand,
                                  __global const uint* vertex_count, __global const real* lane_x,
                                  __global const float4* volume_pull, __global real* lane_v,
                                  __global real* lane_v_before, __global real* lane_pressure) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 root = load3(lane_x, place, 0);
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    store3(lane_pressure, place, 0, zero);
    for (int i = 1; i < (int)params.vertex_stride; ++i) {
        const vec3 g = grid_coordinates(&grid, add3(root, load3(lane_x, place, i)));
        const mask inside = ((mask)(i) < counts) & grid_contains(&grid, g);
        const grid_cell cell = grid_cell_of(&grid, g, inside, PLAIT_TENT_TRILINEAR);
        const node_pull at = pull_at(&grid, cell, volume_pull);
        store3(lane_pressure, place, i, pick3(inside, grid_world(&grid, at.push), zero));
        if (!params.moves)
            continue;
        const vec3 before = load3(lane_v, place, i);
        const vec3 change = grid_world(&grid, at.change);
        const vec3 gained = pick3(inside, axpy3(-at.share, before, change), zero);
        store3(lane_v, place, i, add3(before, gained));
        if (params.history)
            store3(lane_v_before, place, i, add3(load3(lane_v_before, place, i), gained));
    }
}
