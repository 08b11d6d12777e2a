/* roots: the pose of each strand's root at a fraction of the step.
 *
 * Items   strands.
 * Reads   root_from, root_to (each strand's own pose, applied before the head's; only if per_root).
 * Writes  pose.
 * Why     interpolating roots over substeps takes 15 times the strain out of a 10 g shake; TressFX
 *         moves roots once per frame.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pose.clh"

static inline pose_t head_pose(const plait_roots_params* params) {
    const pose_t from = {vload4(0, params->head_from_q), unpack3(vload4(0, params->head_from_t))};
    const pose_t to = {vload4(0, params->head_to_q), unpack3(vload4(0, params->head_to_t))};
    return pose_interpolate(from, to, params->alpha);
}

__kernel void plait_roots(const uint item_count, const plait_roots_params params,
                          __global const float4* root_from, __global const float4* root_to,
                          __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    pose_t result = head_pose(&params);
    if (params.per_root) {
        const pose_t from = pose_load(root_from, strand);
        const pose_t to = pose_load(root_to, strand);
        result = pose_mul(result, pose_interpolate(from, to, params.alpha));
    }
    pose_store(pose, strand, result);
}
