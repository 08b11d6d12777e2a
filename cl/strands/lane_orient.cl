/* lane_orient: orientations of a strand that has had none, from its positions, and those of the
 * step before, from its velocities.
 *
 * Items   strands.
 * Reads   lane_slot, lane_strand, pose, lane_rest, lane_x, lane_v.
 * Writes  lane_q, lane_q_before, of these strands.
 * Source  Bergou et al. 2008: parallel transport carries a frame along a curve without twist. Here
 *         the rest rotation of each joint comes first, and what is left is the shortest turn onto
 *         the segment: of all frames that lie along it, the one with the least energy in the joint.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_scalar.clh"
#include "plait/params.h"

/* `expected` turned so that its x axis lies along `edge`. */
static inline quat laid_along(quat expected, vec3 edge) {
    const vec3 axis = rotate3(expected, vec3_of(1.0f, 0.0f, 0.0f));
    return normalizeq(mulq_by_parts(quat_between(axis, edge), expected));
}

__kernel void plait_lane_orient(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_slot, __global const uint* lane_strand,
                                __global const float4* pose, __global const float* lane_rest,
                                __global const float* lane_x, __global const float* lane_v,
                                __global float* lane_q, __global float* lane_q_before) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const uint lane = lane_slot[2 * item + 1];
    quat q = pose[(size_t)lane_strand_of(lane_strand, lane) * PLAIT_POSE_STRIDE], before = q;
    vec3 x = zero3(), v = lane_read3(lane_v, lane_row(lane, 0, 3, stride, tile), tile);
    for (uint i = 0; i < stride; ++i) {
        const size_t row = lane_row(lane, i, 4, stride, tile);
        const quat rest = lane_readq(lane_rest, row, tile);
        vec3 edge = zero3(), edge_before = edge;
        if (i + 1 < stride) {
            const size_t next = lane_row(lane, i + 1, 3, stride, tile);
            const vec3 x_next = lane_read3(lane_x, next, tile);
            const vec3 v_next = lane_read3(lane_v, next, tile);
            edge = sub3(x_next, x);
            edge_before = axpy3(-params.h, sub3(v_next, v), edge);
            x = x_next;
            v = v_next;
        }
        q = laid_along(mulq_by_parts(q, rest), edge);
        before = laid_along(mulq_by_parts(before, rest), edge_before);
        lane_writeq(lane_q, row, tile, q);
        lane_writeq(lane_q_before, row, tile, before);
    }
}
