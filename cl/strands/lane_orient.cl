/* lane_orient: orientations of strands whose vertices were put elsewhere, or move otherwise.
 *
 * Items   strands, over lanes.
 * Reads   lane_x; lane_x_before.
 * Moves   lane_q, lane_q_before, of strands with a segment that is more than a degree off its
 *         director. Others keep theirs, to the bit.
 *         If params.before: lane_q_before alone, R(e_i -> e_before,i) q_i, of segments that it did not
 *         put so.
 * Source  Bergou et al. 2008: parallel transport, as guide_turns has it. Here
 *         B_i = R(B_(i-1) t_i -> e_i) B_(i-1), B_(-1) the identity, q_i <- B_i q_i, t_i the director of
 *         q_i, e_i segment i as it lies, R the shortest rotation from one direction to the other.
 * Why     The solve aligns each segment by its own shortest turn. Of segments that were put far from
 *         where they were these turn by other angles about the strand from one to the next: twist that
 *         the hair did not have, and that throws it in the first step.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"

#define LANE_ORIENT_ASKEW 0.9998477f /* cos 1 degree */

/* In square, of a director: more than rounding. */
#define LANE_ORIENT_OTHERWISE 1e-8f

static inline vec3 orient_segment(__global const real* lane_x, lane_place place, int i) {
    const vec3 from = i > 0 ? load3(lane_x, place, i) : zero3();
    return sub3(load3(lane_x, place, i + 1), from);
}

static inline mask orient_wanted(__global const real* lane_x, __global const real* lane_q,
                                 lane_place place, int segments) {
    mask wanted = (mask)(0);
    for (int i = 0; i < segments; ++i) {
        const vec3 e = orient_segment(lane_x, place, i);
        const real length = length3(e);
        wanted |= (length > (real)(0.0f)) &
                  (dot3(director(loadq(lane_q, place, i)), e) < LANE_ORIENT_ASKEW * length);
    }
    return wanted;
}

static inline void orient_row(__global real* lane_q, lane_place place, int i, quat turn,
                              mask wanted) {
    const quat q = loadq(lane_q, place, i);
    storeq(lane_q, place, i, pickq(wanted, normalizeq(mulq(turn, q)), q));
}

/* The turn of a segment in the last substep, as its vertices made it. */
static inline void orient_before(__global const real* lane_x, __global const real* lane_x_before,
                                 __global const real* lane_q, __global real* lane_q_before,
                                 lane_place place, int segments) {
    for (int i = 0; i < segments; ++i) {
        const quat back =
            quat_between(orient_segment(lane_x, place, i), orient_segment(lane_x_before, place, i));
        const quat was = loadq(lane_q_before, place, i);
        const quat q = normalizeq(mulq(back, loadq(lane_q, place, i)));
        const vec3 off = sub3(director(q), director(was));
        storeq(lane_q_before, place, i,
               pickq(dot3(off, off) > (real)(LANE_ORIENT_OTHERWISE), q, was));
    }
}

__kernel PLAIT_WIDE void plait_lane_orient(const uint item_count,
                                           const plait_lane_orient_params params,
                                           __global const real* lane_x,
                                           __global const real* lane_x_before,
                                           __global real* lane_q, __global real* lane_q_before) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const int segments = (int)params.vertex_stride - 1;
    if (params.before) {
        orient_before(lane_x, lane_x_before, lane_q, lane_q_before, place, segments);
        return;
    }
    const mask wanted = orient_wanted(lane_x, lane_q, place, segments);
    if (!any_lane(wanted))
        return;
    quat turn = identityq();
    for (int i = 0; i <= segments; ++i) { /* past the last segment as that */
        if (i < segments) {
            const vec3 e = orient_segment(lane_x, place, i);
            const vec3 t = rotate3(turn, director(loadq(lane_q, place, i)));
            const quat bend = normalizeq(mulq(quat_between(t, e), turn));
            turn = pickq(length3(e) > (real)(0.0f), bend, turn);
        }
        orient_row(lane_q, place, i, turn, wanted);
        orient_row(lane_q_before, place, i, turn, wanted);
    }
}
