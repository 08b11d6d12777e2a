/* follow_turns: strands that are at every segment turned as their guides are there.
 *
 * Items   follows, over lanes: follow f is row guide_count + f of position.
 * Reads   lane_strand; pose, guide_turn of the guides; follow_guides, follow_weight, follow_place,
 *         follow_rest, as lanes lie.
 * Writes  position of the follows; padding is a copy of the tip.
 * Source  Hsu et al. 2024 rebuild an interpolated hair from its own rest shape; here without their
 *         solve: x_0 = sum_g w_g (q_g p_0 + t_g), x_i = x_(i-1) + Q_i r_i,
 *         Q_i = n(sum_g w_g s_g n((1-t) Q_(g,a) + t Q_(g,a+1))), a + t = follow_place of i, w the
 *         weights, p_0 and r_i root and segment at rest. Lengths are those of rest, whatever Q_i.
 * Changed s_g, -1 or 1, makes the poses of the guides' roots agree with the first one's, not the
 *         turns: these are the products of small turns from there on, and one that has gone further
 *         than half a turn beyond another is on the other side of it, not beside it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "follows/follow_rows.clh"

#define GUIDES 4

typedef struct {
    mask row[GUIDES];   /* of each guide's turns */
    real share[GUIDES]; /* with the sign that makes the pose of its root agree with the first's */
    uint guides;        /* after which all shares are 0 */
    vec3 root;
} turns_strands;

/* s / |q|, but for a q that vanishes. */
static inline real turns_over(real s, quat q) {
    const real square = dotq(q, q);
    const mask good = square >= (real)(FLT_MIN);
    return pick(good, s / sqrt(pick(good, square, (real)(1.0f))), (real)(0.0f));
}

/* Of the lanes, whose roots are `at` at rest. */
static inline turns_strands turns_of(__global const float4* pose,
                                     __global const uint* follow_guides,
                                     __global const float4* follow_weight, mask lane, vec3 at) {
    turns_strands strands;
    strands.root = zero3();
    strands.guides = 0;
    const quat weights = lane_gather(follow_weight, lane);
    const real weight[GUIDES] = {weights.x, weights.y, weights.z, weights.w};
    quat first = identityq();
#if PLAIT_LANES == 1 /* what loops choose among would lie in private memory */
#pragma unroll
#endif
    for (uint g = 0; g < GUIDES; ++g) {
        mask guide;
        for (uint k = 0; k < PLAIT_LANES; ++k)
            LANE_OF_MASK(guide, k) = (int)follow_guides[GUIDES * LANE_OF_MASK(lane, k) + (int)g];
        const quat q = lane_gather(pose, guide * PLAIT_POSE_STRIDE);
        const quat t = lane_gather(pose, guide * PLAIT_POSE_STRIDE + 1);
        if (g == 0)
            first = q;
        strands.root = axpy3(weight[g], add3(rotate3(q, at), vector_part(t)), strands.root);
        strands.share[g] = pick(dotq(q, first) < (real)(0.0f), -weight[g], weight[g]);
        strands.row[g] = guide * PLAIT_VERTICES;
        strands.guides += any_lane(weight[g] != (real)(0.0f)) ? 1 : 0;
    }
    return strands;
}

/* `sum` and a share of a guide's turn between two of its segments. */
static inline quat turns_add(__global const float4* guide_turn, mask row, real share, real place,
                             quat sum) {
    const real held = clamp(place, (real)(0.0f), (real)(PLAIT_VERTICES - 1));
    const mask a = min(LANE_INT(held), (mask)(PLAIT_VERTICES - 2));
    const real t = held - LANE_REAL(a), zero = (real)(0.0f);
    if (!any_lane(t > zero)) /* no follow has other segments than its guide */
        return addq(sum, scaleq(lane_gather(guide_turn, row + a), share));
    quat q, b;
    lane_gather_two(guide_turn, row + a, &q, &b);
    q = addq(scaleq(q, (real)(1.0f) - t), scaleq(b, pick(dotq(q, b) < zero, -t, t)));
    return addq(sum, scaleq(q, pick(t > zero, turns_over(share, q), share)));
}

static inline vec3 turns_segment(__global const float4* guide_turn, const turns_strands* strands,
                                 quat place, vec3 segment) {
    const real zero = (real)(0.0f);
    const real places[GUIDES] = {place.x, place.y, place.z, place.w};
    quat sum = quat_of(zero, zero, zero, zero);
#if PLAIT_LANES == 1
#pragma unroll
#endif
    for (uint g = 0; g < GUIDES && g < strands->guides; ++g)
        sum = turns_add(guide_turn, strands->row[g], strands->share[g], places[g], sum);
    const real size = turns_over((real)(1.0f), sum);
    return rotate3(pickq(size > zero, scaleq(sum, size), identityq()), segment);
}

__kernel PLAIT_WIDE void
plait_follow_turns(const uint item_count, const plait_follow_turns_params params,
                   __global const uint* lane_strand, __global const float4* pose,
                   __global const float4* guide_turn, __global const uint* follow_guides,
                   __global const float4* follow_weight, __global const real* follow_place,
                   __global const real* follow_rest, __global float4* position) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const mask lane = lane_numbers(place, item_count);
    const turns_strands strands = turns_of(pose, follow_guides, follow_weight, lane,
                                           vector_part(loadq(follow_rest, place, 0)));
    const follow_pointers to = follow_pointers_of(position, params.guide_count, lane_strand, lane);
    const uint lanes = lane_place_strands(place, item_count);
    vec3 way = zero3(); /* from the root: a sum of small numbers */
    for (uint first = 0; first < PLAIT_VERTICES; first += LINE_ROWS) {
        const uint used = min((uint)LINE_ROWS, PLAIT_VERTICES - first);
        lane_elements rows[LINE_ROWS];
        for (uint j = 0; j < used; ++j) {
            const quat rest = loadq(follow_rest, place, first + j);
            if (first + j > 0)
                way = add3(way,
                           turns_segment(guide_turn, &strands,
                                         loadq(follow_place, place, first + j), vector_part(rest)));
            rows[j] = lane_to_elements(quat_of_parts(add3(strands.root, way), rest.w));
        }
        follow_write(&to, rows, first, used, lanes);
    }
}
