/* skin: the pose of each strand's root from four weighted bones.
 *
 * Items   strands.
 * Reads   bone_matrix, bone_index, bone_weight, rest (of the root).
 * Writes  pose.
 * Source  linear blend skinning; the rotation closest to the blend: roots/skin.clh.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "roots/skin.clh"

__kernel void plait_skin(const uint item_count, const plait_layout_params params,
                         __global const float4* bone_matrix, __global const uint* bone_index,
                         __global const float* bone_weight, __global const float4* rest,
                         __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    float4 r0 = (float4)(0.0f), r1 = r0, r2 = r0;
    for (uint i = 4 * strand; i < 4 * strand + 4; ++i) {
        const float weight = bone_weight[i];
        __global const float4* bone = bone_matrix + 3 * (size_t)bone_index[i];
        if (weight > 0.0f) {
            r0 += weight * bone[0];
            r1 += weight * bone[1];
            r2 += weight * bone[2];
        }
    }
    skin_store(pose, strand, r0, r1, r2, unpack3(rest[(size_t)strand * params.vertex_stride]));
}
