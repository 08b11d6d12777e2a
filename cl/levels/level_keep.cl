/* level_keep: what is shown, in the frames of the roots, to be shown again where they are then; or what
 * is lacking from there to where vertices shall be.
 *
 * Items   vertices.
 * Reads   root_guide; root_pose; position.
 * Moves   held: whole 1: pose^-1(position), w of position; 0: q^-1(held - position), w kept.
 * Source  ours; with whole 0 the offset of inertialisation (Bollo 2018).
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_level_keep(const uint item_count, const plait_level_params params,
                               __global const uint* root_guide, __global const float4* root_pose,
                               __global const float4* position, __global float4* held) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t root = pose_load(root_pose, root_guide[item / params.vertex_stride]);
    const float4 x = position[item], was = held[item];
    held[item] = params.whole
                     ? pack3(pose_apply_inverse(root, unpack3(x)), x.w)
                     : pack3(rotate3(conjq(root.q), sub3(unpack3(was), unpack3(x))), was.w);
}
