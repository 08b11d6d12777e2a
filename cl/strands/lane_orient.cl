/* lane_orient: orientations of strands whose vertices were put elsewhere, or move otherwise.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, pose, lane_material, lane_rest, lane_x; lane_x_before.
 * Moves   lane_q, lane_q_before, of strands with a segment that is more than a degree off its
 *         director. Others keep theirs, to the bit.
 *         If params.before: lane_q_before alone, R(e_i -> e_before,i) q_i, of segments that it did not
 *         put so.
 * Source  Bergou et al. 2008: parallel transport, as guide_turns has it. Here
 *         B_i = R(B_(i-1) t_i -> e_i) B_(i-1), B_(-1) the identity, q_i <- B_i q_i, t_i the director of
 *         q_i, e_i segment i as it lies, R the shortest rotation from one direction to the other.
 *         Then each segment turns about itself to where the joints hold least, as twist without inertia
 *         does (Bergou et al. 2008), in Newton steps of all segments at once.
 * Why     The solve aligns each segment by its own shortest turn. Of segments that were put far from
 *         where they were these turn by other angles about the strand from one to the next: twist that
 *         the hair did not have, and that throws it in the first step. So does twist that it would have
 *         where it lies, and lacks.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "strands/rod_joint.clh"

#define LANE_ORIENT_ASKEW 0.9998477f /* cos 1 degree */

/* In square, of a director: more than rounding. */
#define LANE_ORIENT_OTHERWISE 1e-8f

#define LANE_ORIENT_STEPS 4

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

/* A joint's form in the turns a of the segment after it and b of that before, each about itself:
 * 1/2 (after a^2 + before b^2) - between a b - pull a + pull_before b. */
typedef struct {
    real after, before, between; /* N m */
    real pull, pull_before;      /* N m */
} orient_joint;

/* Of the joint before segment i, which expects `expected` of it; `before`: the director before it. */
static inline orient_joint orient_joint_of(const lane_step* step, int i, quat expected, quat q,
                                           vec3 before) {
    const vec3 t = director(q);
    const quat r = mulq(expected, conjq(q));
    const real side = copysign((real)(1.0f), r.w);
    const vec3 e = vec3_of(side * r.x, side * r.y, side * r.z);
    const real bend = lane_material_at(step, i, PLAIT_LANE_BEND);
    const rod_section k = rod_section_of(step, i);
    const vec3 moment = add3(scale3(e, 0.5f * bend), rod_section_moment(k, q, expected));
    /* `before` as the segment after the joint sees it; as the solve has it, articulated.clh */
    const vec3 n = axpy3(side * r.w, before, cross3(before, e));
    const vec3 along = director(expected),
               across = rotate3(expected, vec3_of((real)(0.0f), (real)(0.0f), (real)(1.0f)));
    const real at = dot3(along, t), an = dot3(along, n);
    const real ct = dot3(across, t), cn = dot3(across, n);
    const orient_joint joint = {0.25f * (bend + k.twist * at * at + k.cross * ct * ct),
                                0.25f * (bend + k.twist * an * an + k.cross * cn * cn),
                                0.25f * (bend * dot3(t, n) + k.twist * at * an + k.cross * ct * cn),
                                dot3(moment, t), dot3(moment, before)};
    return joint;
}

/* One Newton step, by elimination from root to tip. `root`: what the first joint expects. */
static inline void orient_untwist(const lane_step* step, quat root, __global const real* lane_rest,
                                  __global real* lane_q, __global real* lane_q_before,
                                  mask wanted) {
    const lane_place place = step->place;
    const real none = (real)(0.0f);
    real share[PLAIT_VERTICES], turn[PLAIT_VERTICES]; /* turn_i = turn[i] + share[i] turn_(i+1) */
    quat q = loadq(lane_q, place, 0);
    orient_joint joint = orient_joint_of(step, 0, root, q, zero3());
    real last_share = none, last_turn = none;
    for (int i = 0; i < step->segments; ++i) {
        orient_joint next = {none, none, none, none, none};
        if (i + 1 < step->segments) {
            const quat expected = mulq(q, loadq(lane_rest, place, i + 1));
            const vec3 t = director(q);
            q = loadq(lane_q, place, i + 1);
            next = orient_joint_of(step, i + 1, expected, q, t);
        }
        const real stiff = joint.after + next.before - joint.between * last_share;
        const real pull = joint.pull - next.pull_before + joint.between * last_turn;
        const mask stands = stiff > none; /* past the tip nothing does */
        last_share = share[i] = pick(stands, next.between / stiff, none);
        last_turn = turn[i] = pick(stands, pull / stiff, none);
        joint = next;
    }
    real angle = none;
    for (int i = step->segments - 1; i >= 0; --i) {
        angle = turn[i] + share[i] * angle;
        const vec3 w = scale3(director(loadq(lane_q, place, i)), 0.5f * angle);
        const quat about = quat_of(w.x, w.y, w.z, (real)(1.0f));
        orient_row(lane_q, place, i, about, wanted);
        orient_row(lane_q_before, place, i, about, wanted);
    }
}

__kernel PLAIT_WIDE void
plait_lane_orient(const uint item_count, const plait_lane_orient_params params,
                  __global const uint* lane_strand, __global const float4* pose,
                  __global const real* lane_material, __global const real* lane_rest,
                  __global const real* lane_x, __global const real* lane_x_before,
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
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    lane_step step;
    step.place = place;
    step.material = lane_material;
    step.segments = segments;
    const quat root =
        mulq(gatherq(pose, &strands, PLAIT_POSE_STRIDE, 0), loadq(lane_rest, place, 0));
    for (int k = 0; k < LANE_ORIENT_STEPS; ++k)
        orient_untwist(&step, root, lane_rest, lane_q, lane_q_before, wanted);
}
