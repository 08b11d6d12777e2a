/* local_shape: rest-shape constraint between neighbouring segments, root to tip.
 *
 * Items   strands, each walked by one work-item.
 * Reads   rest, vertex_count, pose.
 * Moves   position.
 * Source  Han & Harada 2012, section 3; TressFX 4.1. With b the rest strand turned by the root,
 *         i = 1 .. count-2: R turns b_i - b_(i-1) to p_i - p_(i-1),
 *         delta = k (R (b_(i+1) - b_i) + p_i - p_(i+1)), k = min(stiffness, 0.95) / 2;
 *         p_i -= delta and p_(i+1) += delta where free.
 * Changed all iterations run in one launch: the strand is one work-item's own, so none can read
 *         another's half-done pass (the original has no barrier between its iterations).
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"
#include "base/strand.clh"
#include "plait/constants.h"

/* How far p1 and p2 go towards each other's place in the rest shape; b are rest positions. */
static inline vec3 shape_delta(float k, vec3 b0, vec3 b1, vec3 b2, vec3 p0, vec3 p1, vec3 p2) {
    const vec3 turned = turn_between(sub3(b1, b0), sub3(p1, p0), sub3(b2, b1));
    return scale3(sub3(add3(turned, p1), p2), k);
}

/* One pass over a strand of count >= 3 vertices, three neighbours at a time in registers. */
static inline void shape_pass(float k, uint count, quat q, __global const float4* rest,
                              __global float4* position) {
    vec3 b0 = rotate3(q, unpack3(rest[0])), b1 = rotate3(q, unpack3(rest[1]));
    vec3 p0 = unpack3(position[0]);
    float4 p1 = position[1];
    for (uint i = 1u; i + 1u < count; ++i) {
        const vec3 b2 = rotate3(q, unpack3(rest[i + 1u]));
        float4 p2 = position[i + 1u];
        const vec3 delta = shape_delta(k, b0, b1, b2, p0, unpack3(p1), unpack3(p2));
        if (is_free(p1))
            p1 = pack3(sub3(unpack3(p1), delta), p1.w);
        if (is_free(p2))
            p2 = pack3(add3(unpack3(p2), delta), p2.w);
        position[i] = p1;
        b0 = b1, b1 = b2;
        p0 = unpack3(p1), p1 = p2;
    }
    position[count - 1u] = p1;
}

__kernel void plait_local_shape(const uint item_count, const plait_local_shape_params params,
                                __global const float4* rest, __global const uint* vertex_count,
                                __global const float4* pose, __global float4* position) {
    const uint strand = get_global_id(0);
    if (strand >= item_count || vertex_count[strand] < 3u)
        return;
    const size_t root = (size_t)strand * params.vertex_stride;
    const quat q = pose_load(pose, strand).q;
    const float k = 0.5f * min(params.stiffness, PLAIT_LOCAL_SHAPE_MAX_STIFFNESS);
    for (uint iteration = 0u; iteration < params.iterations; ++iteration)
        shape_pass(k, vertex_count[strand], q, rest + root, position + root);
}
