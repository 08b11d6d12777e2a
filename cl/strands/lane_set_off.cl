/* lane_set_off: gives strands the motion with which their head sets off, as if it had moved so before.
 *
 * After a teleport, a reset or creation nobody knows how fast the head moves until it is told where to
 * go next. Strands keep their motion relative to the head. What they had of the head's own so far, M
 * from pose_before to pose_was, turned as roots were from there to pose, gives way to what the head has
 * now, N from pose to pose_next.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose_before, pose_was, pose, pose_next, lane_x.
 * Moves   lane_v, lane_q_before, and BDF2's lane_x_before, lane_v_before.
 * Source  ours. The velocity of a rigid motion is the difference of its places that the integrator
 *         takes: (r - r1)/h, with BDF2 (3r - 4 r1 + r2)/2h, r1 and r2 one and two substeps ago, so
 *         that hair at rest on a head that turns evenly stays where it is.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"
#include "plait/constants.h"

/* A rigid motion of a substep, seen from where the root is at its end: the point at offset r was at
 * back r - step when it began. */
typedef struct {
    quat back;
    vec3 step; /* m, of the root */
} set_off_motion;

static inline vec3 set_off_earlier(set_off_motion m, vec3 r) {
    return sub3(rotate3(m.back, r), m.step);
}

/* m/s, of the point at offset r at the motion's end. */
static inline vec3 set_off_velocity(set_off_motion m, vec3 r, float h, int bdf2) {
    const vec3 first = set_off_earlier(m, r), last = sub3(r, first);
    if (!bdf2)
        return scale3(last, (real)(1.0f / h));
    /* (3r - 4 r1 + r2)/2h = (3 (r - r1) - (r1 - r2))/2h */
    const vec3 before = sub3(first, set_off_earlier(m, first));
    return scale3(sub3(scale3(last, (real)(3.0f)), before), (real)(0.5f / h));
}

/* The same motion, a substep before. */
static inline set_off_motion set_off_before(set_off_motion m) {
    const set_off_motion before = {m.back, rotate3(m.back, m.step)};
    return before;
}

/* Whether the motions differ by a speed of at least `jump`. */
static inline mask set_off_jumps(set_off_motion was, set_off_motion is, quat change,
                                 const plait_set_off_params* params) {
    const vec3 way = sub3(is.step, was.step);
    const vec3 turn = scale3(vector_part(change), (real)(2.0f * PLAIT_SET_OFF_REACH));
    const float least = params->jump * params->h;
    return dot3(way, way) + dot3(turn, turn) >= (real)(least * least);
}

static inline void set_off_vertex(const plait_set_off_params* params, lane_place place, int i,
                                  mask jumps, quat change, set_off_motion was, set_off_motion is,
                                  __global const real* lane_x, __global real* lane_v,
                                  __global real* lane_q_before, __global real* lane_x_before,
                                  __global real* lane_v_before) {
    const vec3 root = zero3();
    const vec3 x = i > 0 ? load3(lane_x, place, i) : root;
    const vec3 v = load3(lane_v, place, i);
    const vec3 gained = sub3(set_off_velocity(is, x, params->h, i > 0 && params->history),
                             set_off_velocity(was, x, params->h, i > 0 && params->history));
    store3(lane_v, place, i, pick3(jumps, add3(v, gained), v));
    const quat q = loadq(lane_q_before, place, i);
    storeq(lane_q_before, place, i, pickq(jumps, mulq(change, q), q));
    if (!params->history)
        return;
    const vec3 x_before = load3(lane_x_before, place, i);
    if (i == 0) {
        const vec3 shift = sub3(was.step, is.step); /* its path need not be straight */
        store3(lane_x_before, place, 0, pick3(jumps, add3(x_before, shift), x_before));
        return;
    }
    const vec3 turned = rotate3(change, x_before);
    store3(lane_x_before, place, i, pick3(jumps, turned, x_before));
    const vec3 v_before = load3(lane_v_before, place, i);
    const vec3 relative =
        sub3(v_before, set_off_velocity(set_off_before(was), x_before, params->h, 1));
    const vec3 moved =
        add3(rotate3(change, relative), set_off_velocity(set_off_before(is), turned, params->h, 1));
    store3(lane_v_before, place, i, pick3(jumps, moved, v_before));
}

__kernel PLAIT_WIDE void
plait_lane_set_off(const uint item_count, const plait_set_off_params params,
                   __global const uint* lane_strand, __global const float4* rest,
                   __global const float4* pose_before, __global const float4* pose_was,
                   __global const float4* pose, __global const float4* pose_next,
                   __global const real* lane_x, __global real* lane_v, __global real* lane_q_before,
                   __global real* lane_x_before, __global real* lane_v_before) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const lane_pose a = lane_load_pose(rest, pose_before, &strands, params.row_stride);
    const lane_pose b = lane_load_pose(rest, pose, &strands, params.row_stride);
    const lane_pose c = lane_load_pose(rest, pose_next, &strands, params.row_stride);
    const lane_pose placed = lane_load_pose(rest, pose_was, &strands, params.row_stride);
    const quat turn = mulq(b.q, conjq(placed.q)); /* of the place */
    const set_off_motion was = {mulq(mulq(turn, mulq(a.q, conjq(placed.q))), conjq(turn)),
                                rotate3(turn, sub3(placed.root, a.root))};
    const set_off_motion next = {mulq(b.q, conjq(c.q)), sub3(c.root, b.root)};
    const set_off_motion is = set_off_before(next); /* as if it had brought the head here */
    const quat change = mulq(is.back, conjq(was.back));
    const mask jumps = set_off_jumps(was, is, change, &params);
    if (!any_lane(jumps))
        return;
    for (int i = 0; i < (int)params.vertex_stride; ++i)
        set_off_vertex(&params, place, i, jumps, change, was, is, lane_x, lane_v, lane_q_before,
                       lane_x_before, lane_v_before);
}
