/* tressfx_reset: every vertex at its skinned rest position, at rest.
 *
 * Items   vertices, padding included (its rest position is the tip's).
 * Reads   rest, pose.
 * Writes  position (w, the inverse mass, is kept) and both histories, equal to it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_tressfx_reset(const uint item_count, const plait_layout_params params,
                                  __global const float4* rest, __global const float4* pose,
                                  __global float4* position, __global float4* position_prev,
                                  __global float4* position_prev2) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t root = pose_load(pose, item / params.vertex_stride);
    const float4 x = pack3(pose_apply(root, unpack3(rest[item])), position[item].w);
    position[item] = x;
    position_prev[item] = x;
    position_prev2[item] = x;
}
