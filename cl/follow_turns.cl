/* follow_turns: strands that are at every segment turned as their guides are there.
 *
 * Items   follows: strand f here is row guide_count + f of position.
 * Reads   pose, guide_turn of the guides; follow_guides, follow_weight, follow_place, follow_rest.
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
#include "common/pose.clh"

/* Turn of a guide, whose row begins at `row`, between two of its segments. */
static inline quat turn_at(__global const float4* guide_turn, uint row, uint stride, float place) {
    const float held = clamp(place, 0.0f, (float)(stride - 1));
    const uint a = min((uint)held, stride - 2u);
    return nlerpq(guide_turn[row + a], guide_turn[row + a + 1], held - (float)a);
}

/* A share of that guide, with the sign that makes the pose of its root agree with `first`. */
static inline float signed_share(pose_t pose, quat first, float share) {
    return dotq(pose.q, first) < 0.0f ? -share : share;
}

/* Shares that are 0 come last. */
static inline quat mean_turn(__global const float4* guide_turn, uint4 row, uint stride,
                             float4 share, float4 place) {
    quat sum = scaleq(turn_at(guide_turn, row.x, stride, place.x), share.x);
    if (share.y != 0.0f)
        sum = addq(sum, scaleq(turn_at(guide_turn, row.y, stride, place.y), share.y));
    if (share.z != 0.0f)
        sum = addq(sum, scaleq(turn_at(guide_turn, row.z, stride, place.z), share.z));
    if (share.w != 0.0f)
        sum = addq(sum, scaleq(turn_at(guide_turn, row.w, stride, place.w), share.w));
    return normalizeq(sum);
}

__kernel void plait_follow_turns(const uint item_count, const plait_follow_turns_params params,
                                 __global const float4* pose, __global const float4* guide_turn,
                                 __global const uint* follow_guides,
                                 __global const float4* follow_weight,
                                 __global const float4* follow_place,
                                 __global const float4* follow_rest, __global float4* position) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count)
        return;
    const uint4 guide = vload4(item, follow_guides);
    const float4 weight = follow_weight[item];
    const size_t from = (size_t)item * stride, to = from + (size_t)params.guide_count * stride;
    const float4 start = follow_rest[from];
    const vec3 at = unpack3(start);
    const pose_t a = pose_load(pose, guide.x), b = pose_load(pose, guide.y);
    const pose_t c = pose_load(pose, guide.z), d = pose_load(pose, guide.w);
    vec3 root = scale3(pose_apply(a, at), weight.x);
    root = axpy3(weight.y, pose_apply(b, at), root);
    root = axpy3(weight.z, pose_apply(c, at), root);
    root = axpy3(weight.w, pose_apply(d, at), root);
    const float4 share = (float4)(weight.x, signed_share(b, a.q, weight.y),
                                  signed_share(c, a.q, weight.z), signed_share(d, a.q, weight.w));
    position[to] = pack3(root, start.w);
    vec3 way = zero3(); /* from the root: a sum of small numbers */
    for (uint i = 1; i < stride; ++i) {
        const float4 segment = follow_rest[from + i];
        const quat q = mean_turn(guide_turn, guide * stride, stride, share, follow_place[from + i]);
        way = add3(way, rotate3(q, unpack3(segment)));
        position[to + i] = pack3(add3(root, way), segment.w);
    }
}
