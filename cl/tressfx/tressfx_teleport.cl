/* tressfx_teleport: carry the state rigidly from one root pose to another, motion relative to the root
 * kept.
 *
 * Items   vertices.
 * Reads   pose_from, pose_to.
 * Moves   position and both histories: x <- to(from^-1(x)). Why TressFX has no such call: a moved
 *         character's hair is dragged along, and a 30 m jump stretches its worst segment 640 times.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

static inline float4 carry(pose_t from, pose_t to, float4 x) {
    return pack3(pose_apply(to, pose_apply_inverse(from, unpack3(x))), x.w);
}

__kernel void plait_tressfx_teleport(const uint item_count, const plait_layout_params params,
                                     __global const float4* pose_from,
                                     __global const float4* pose_to, __global float4* position,
                                     __global float4* position_prev,
                                     __global float4* position_prev2) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t from = pose_load(pose_from, item / params.vertex_stride);
    const pose_t to = pose_load(pose_to, item / params.vertex_stride);
    position[item] = carry(from, to, position[item]);
    position_prev[item] = carry(from, to, position_prev[item]);
    position_prev2[item] = carry(from, to, position_prev2[item]);
}
