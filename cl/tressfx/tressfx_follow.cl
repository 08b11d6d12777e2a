/* tressfx_follow: place follow strands beside their guides.
 *
 * Items   vertices of follows: strand f here is row guide_count + f of position.
 * Reads   rest, pose, vertex_count of the guides; follow_guide, follow_offset; position of the
 *         guides.
 * Writes  position of the follows, w of the guide's; padding is a copy of the tip.
 * Source  TressFX 4.1: x_follow = x_guide + (tip_separation i/count + 1) offset.
 * Changed PLAIT_FOLLOW_ROTATING turns the offset by the root's pose and then with the segment, by
 *         the shortest rotation from its skinned rest direction. Published offsets are fixed in
 *         rest space, so follows keep standing to the same side of the world when the head turns,
 *         and a lock folds flat when it swings along its offset.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

/* The offset turned by the root's pose and then by the segment at `vertex`, from its skinned rest
 * direction to the present one; the tip has the segment before it. `guide` is the first element of
 * the guide's row. */
static inline vec3 turn_offset(vec3 offset, quat root_q, size_t guide, uint vertex, uint count,
                               __global const float4* rest, __global const float4* position) {
    const size_t segment = guide + min(vertex, count - 2u);
    const vec3 before = sub3(unpack3(rest[segment + 1]), unpack3(rest[segment]));
    const vec3 now = sub3(unpack3(position[segment + 1]), unpack3(position[segment]));
    return turn_between(rotate3(root_q, before), now, rotate3(root_q, offset));
}

__kernel void plait_tressfx_follow(const uint item_count, const plait_tressfx_follow_params params,
                                   __global const float4* rest, __global const float4* pose,
                                   __global const uint* vertex_count,
                                   __global const uint* follow_guide,
                                   __global const float4* follow_offset,
                                   __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint follower = item / params.vertex_stride;
    const uint strand = follow_guide[follower];
    const uint count = vertex_count[strand];
    const uint vertex = min(item % params.vertex_stride, count - 1u);
    const size_t guide = (size_t)strand * params.vertex_stride;
    vec3 offset = unpack3(follow_offset[follower]);
    if (params.form == PLAIT_FOLLOW_ROTATING)
        offset =
            turn_offset(offset, pose_load(pose, strand).q, guide, vertex, count, rest, position);
    const float spread = params.tip_separation * ((float)vertex / (float)count) + 1.0f;
    const float4 x = position[guide + vertex];
    position[(size_t)params.guide_count * params.vertex_stride + item] =
        pack3(axpy3(spread, offset, unpack3(x)), x.w);
}
