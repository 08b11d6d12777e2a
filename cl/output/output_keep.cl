/* output_keep: keep the positions of a finished step in their root frames, for `output`.
 *
 * Items   vertices.
 * Reads   pose, position.
 * Writes  position_local: pose^-1(position), w kept.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_output_keep(const uint item_count, const plait_layout_params params,
                                __global const float4* pose, __global const float4* position,
                                __global float4* position_local) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t root = pose_load(pose, item / params.vertex_stride);
    const float4 x = position[item];
    position_local[item] = pack3(pose_apply_inverse(root, unpack3(x)), x.w);
}
