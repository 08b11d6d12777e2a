/* tressfx_set_off: gives hair the motion with which its head sets off, as if it had moved so before.
 *
 * Items   vertices.
 * Reads   rest, pose_before, pose_was, pose, pose_next.
 * Moves   both histories. The motion from pose_before to pose_was, carried to pose, brought them here;
 *         they now come from where the motion from pose to pose_next would have brought them from. As
 *         lane_set_off, which says why.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"
#include "plait/constants.h"

/* `pose` after the rigid motion that takes `from` to `to`. */
static inline pose_t carried(pose_t pose, pose_t from, pose_t to) {
    const quat turn = mulq(to.q, conjq(from.q));
    pose_t moved;
    moved.q = mulq(turn, pose.q);
    moved.t = add3(to.t, rotate3(turn, sub3(pose.t, from.t)));
    return moved;
}

/* The pose before b of a motion that leads from b to c. */
static inline pose_t earlier(pose_t b, pose_t c) {
    return carried(b, c, b);
}

static inline float4 change(pose_t from, pose_t to, float4 x) {
    return pack3(pose_apply(to, pose_apply_inverse(from, unpack3(x))), x.w);
}

static inline int jumps(pose_t was, pose_t is, vec3 root, const plait_set_off_params* params) {
    const vec3 way = sub3(pose_apply(was, root), pose_apply(is, root));
    const vec3 turn = scale3(vector_part(mulq(is.q, conjq(was.q))), 2.0f * PLAIT_SET_OFF_REACH);
    const float least = params->jump * params->h;
    return dot3(way, way) + dot3(turn, turn) >= least * least;
}

__kernel void plait_tressfx_set_off(const uint item_count, const plait_set_off_params params,
                                    __global const float4* rest, __global const float4* pose_before,
                                    __global const float4* pose_was, __global const float4* pose,
                                    __global const float4* pose_next,
                                    __global float4* position_prev,
                                    __global float4* position_prev2) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = item / params.vertex_stride;
    const pose_t now = pose_load(pose, strand);
    const pose_t was = carried(pose_load(pose_before, strand), pose_load(pose_was, strand), now);
    const pose_t is = earlier(now, pose_load(pose_next, strand));
    if (!jumps(was, is, unpack3(rest[(size_t)strand * params.row_stride]), &params))
        return;
    position_prev[item] = change(was, is, position_prev[item]);
    position_prev2[item] = change(earlier(was, now), earlier(is, now), position_prev2[item]);
}
