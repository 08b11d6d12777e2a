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
#include "base/lane_step.clh"
#include "grid/lane_nodes.clh"

__kernel PLAIT_WIDE void
plait_volume_gather(const uint item_count, const plait_lane_volume_params params,
                    __global const uint* lane_strand, __global const uint* vertex_count,
                    __global const real* lane_x, __global const float4* volume_pull,
                    __global real* lane_v, __global real* lane_v_before,
                    __global real* lane_pressure) {
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
        lane_fetch(lane_x, place, 3, (size_t)i + PLAIT_ROWS_AHEAD);
        lane_fetch(lane_v, place, 3, (size_t)i + PLAIT_ROWS_AHEAD);
        lane_fetch(lane_pressure, place, 3, (size_t)i + PLAIT_ROWS_AHEAD);
        const vec3 g = grid_coordinates(&grid, add3(root, load3(lane_x, place, i)));
        const mask inside = ((mask)(i) < counts) & grid_contains(&grid, g);
        const grid_cell cell = grid_cell_of(&grid, g, inside, PLAIT_TENT_TRILINEAR);
        /* m/s and, in w, the share of its own velocity that goes; m/s^2; along the grid's axes */
        quat change_at, push_at;
        lane_two_at(&grid, &cell, volume_pull, &change_at, &push_at);
        const vec3 push = grid_world(&grid, vec3_of(push_at.x, push_at.y, push_at.z));
        store3(lane_pressure, place, i, pick3(inside, push, zero));
        if (!params.moves)
            continue;
        const vec3 before = load3(lane_v, place, i);
        const vec3 change = grid_world(&grid, vec3_of(change_at.x, change_at.y, change_at.z));
        const vec3 gained = pick3(inside, axpy3(-change_at.w, before, change), zero);
        store3(lane_v, place, i, add3(before, gained));
        if (params.history)
            store3(lane_v_before, place, i, add3(load3(lane_v_before, place, i), gained));
    }
}
