/* level_show: what level_keep kept, where the roots are now.
 *
 * Items   vertices.
 * Reads   root_guide; root_pose; held.
 * Moves   position: whole 1: it is pose(held), w of held; 0: share q held is added, w kept.
 * Source  ours; with whole 0 inertialisation (Bollo 2018), by a share that the host takes from the time.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_level_show(const uint item_count, const plait_level_params params,
                               __global const uint* root_guide, __global const float4* root_pose,
                               __global const float4* held, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t root = pose_load(root_pose, root_guide[item / params.vertex_stride]);
    const float4 kept = held[item], x = position[item];
    position[item] =
        params.whole ? pack3(pose_apply(root, unpack3(kept)), kept.w)
                     : pack3(axpy3(params.share, rotate3(root.q, unpack3(kept)), unpack3(x)), x.w);
}
