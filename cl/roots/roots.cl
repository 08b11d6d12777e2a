/* roots: the pose of each strand's root at a fraction of the step.
 *
 * Items   strands.
 * Reads   root_before, root_from, root_to (each strand's own pose, applied before the head's; only if
 *         per_root, the first only if bends, too).
 * Writes  pose.
 * Why     interpolating roots over substeps takes 15 times the strain out of a 10 g shake; TressFX
 *         moves roots once per frame. On straight paths the velocity jumps at every step, and BDF2
 *         makes accelerations of both signs of it: the parabola through the last three steps takes a
 *         quarter of the error away with two substeps, and two fifths with four.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

/* On the parabola through before, at -1, from, at 0, and to, at 1. */
static inline pose_t pose_on_parabola(pose_t before, pose_t from, pose_t to, real s) {
    const real bend = 0.5f * s * (s - 1.0f), at_from = 1.0f - s - 2.0f * bend, at_to = s + bend;
    pose_t pose;
    pose.t = add3(add3(scale3(from.t, at_from), scale3(to.t, at_to)), scale3(before.t, bend));
    const real to_sign = dotq(from.q, to.q) < 0.0f ? -at_to : at_to;
    const real before_sign = dotq(from.q, before.q) < 0.0f ? -bend : bend;
    pose.q = normalizeq(
        addq(addq(scaleq(from.q, at_from), scaleq(to.q, to_sign)), scaleq(before.q, before_sign)));
    return pose;
}

static inline pose_t head_pose(const plait_roots_params* params) {
    const pose_t from = {vload4(0, params->head_from_q), unpack3(vload4(0, params->head_from_t))};
    const pose_t to = {vload4(0, params->head_to_q), unpack3(vload4(0, params->head_to_t))};
    if (!params->bends)
        return pose_interpolate(from, to, params->alpha);
    const pose_t before = {vload4(0, params->head_before_q),
                           unpack3(vload4(0, params->head_before_t))};
    return pose_on_parabola(before, from, to, params->alpha);
}

__kernel PLAIT_WIDE void plait_roots(const uint item_count, const plait_roots_params params,
                                     __global const float4* root_before,
                                     __global const float4* root_from,
                                     __global const float4* root_to, __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    pose_t result = head_pose(&params);
    if (params.per_root) {
        const pose_t from = pose_load(root_from, strand);
        const pose_t to = pose_load(root_to, strand);
        const pose_t own =
            params.bends ? pose_on_parabola(pose_load(root_before, strand), from, to, params.alpha)
                         : pose_interpolate(from, to, params.alpha);
        result = pose_mul(result, own);
    }
    pose_store(pose, strand, result);
}
