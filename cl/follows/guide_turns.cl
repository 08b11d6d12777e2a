/* guide_turns: the rotation that takes every segment of a guide from rest to where it is.
 *
 * Items   guides.
 * Reads   rest, or where guides hung as their map was bound; pose, vertex_count, position.
 * Writes  guide_turn: of segment i -> i+1; from the tip on a copy of the last.
 * Source  Bergou et al. 2008: parallel transport carries a frame along a curve without twist. Here
 *         Q_i = R(Q_(i-1) r_i -> e_i) Q_(i-1), Q_(-1) the pose of the root, r_i and e_i segment i at
 *         rest and now, R the shortest rotation from one direction to the other: each joint of the
 *         guide turns as it must and no further.
 * Changed The shortest rotation from every segment's own rest direction, as tressfx_follow has it, jumps
 *         where a segment has turned by half a turn; this jumps where a single joint has.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_guide_turns(const uint item_count, const plait_layout_params params,
                                __global const float4* rest, __global const float4* pose,
                                __global const uint* vertex_count, __global const float4* position,
                                __global float4* guide_turn) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count)
        return;
    const size_t row = (size_t)item * stride;
    const uint count = vertex_count[item];
    quat q = pose_load(pose, item).q;
    vec3 r = unpack3(rest[row]), x = unpack3(position[row]);
    for (uint i = 0; i < stride; ++i) {
        if (i + 1 < count) {
            const vec3 r_next = unpack3(rest[row + i + 1]), x_next = unpack3(position[row + i + 1]);
            const quat bend = quat_between(rotate3(q, sub3(r_next, r)), sub3(x_next, x));
            q = normalizeq(mulq_by_parts(bend, q));
            r = r_next;
            x = x_next;
        }
        guide_turn[row + i] = q;
    }
}
