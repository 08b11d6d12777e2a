/* lane_pack: positions and their Verlet history back to lane state, after the inter-hair step or
 * the user changed them. Orientations are kept.
 *
 * Items   vertices of the lanes in use.
 * Reads   lane_strand, vertex_count, position, position_prev.
 * Moves   lane_x, lane_v, with BDF2 lane_x_before, lane_v_before, of every vertex but the root.
 *         lane_normal_force is 0 where a vertex was moved.
 *         What is as lane_unpack wrote it stays as it is here, to the bit: a place in the world has lost
 *         digits that an offset from the root has.
 *         With params.history 2 a vertex was as much faster in the step before.
 * Source  ours: what changed the velocity changes that of the step before by as much. BDF2, which
 *         goes on from (4v - v_before)/3, would else make 3/2 of it in the end.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_scalar.clh"
#include "plait/params.h"

static inline int same3(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* As lane_unpack has it. */
static inline vec3 unpack_prev(vec3 x, vec3 v, float h) {
    return vec3_of(x.x - h * v.x, x.y - h * v.y, x.z - h * v.z);
}

__kernel void plait_lane_pack(const uint item_count, const plait_lane_history_params params,
                              __global const uint* lane_strand, __global const uint* vertex_count,
                              __global const float4* position, __global const float4* position_prev,
                              __global float* lane_x, __global float* lane_v,
                              __global float* lane_x_before, __global float* lane_v_before,
                              __global float* lane_normal_force) {
    const uint item = get_global_id(0), row = item % params.vertex_stride;
    if (item >= item_count || row == 0)
        return;
    const uint strand = lane_strand_of(lane_strand, item / params.vertex_stride);
    if (row >= vertex_count[strand])
        return;
    const size_t vertex = (size_t)strand * params.row_stride + row;
    const vec3 root = unpack3(position[vertex - row]), x = unpack3(position[vertex]);
    const size_t here = lane_element(item, params.vertex_stride, params.tile);
    const vec3 offset = lane_read3(lane_x, here, params.tile);
    const vec3 was = lane_read3(lane_v, here, params.tile);
    const vec3 shown = add3(root, offset), prev = unpack3(position_prev[vertex]);
    if (!same3(shown, x)) {
        const vec3 moved = sub3(x, root);
        lane_write3(lane_x, here, params.tile, moved);
        lane_normal_force[lane_row(item / params.vertex_stride, row, 1, params.vertex_stride,
                                   params.tile)] = 0.0f;
        if (params.history)
            lane_write3(lane_x_before, here, params.tile,
                        add3(lane_read3(lane_x_before, here, params.tile), sub3(moved, offset)));
    } else if (same3(unpack_prev(shown, was, params.h), prev)) {
        return;
    }
    const vec3 v = div3(sub3(x, prev), params.h);
    if (params.history) {
        const vec3 gained = sub3(v, was);
        lane_write3(lane_v_before, here, params.tile,
                    add3(lane_read3(lane_v_before, here, params.tile), gained));
        if (params.history == 2u)
            lane_write3(lane_x_before, here, params.tile,
                        axpy3(-params.h, gained, lane_read3(lane_x_before, here, params.tile)));
    }
    lane_write3(lane_v, here, params.tile, v);
}
