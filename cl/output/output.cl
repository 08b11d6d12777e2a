/* output: interpolate between the last two finished steps, attached to the roots of now.
 *
 * Items   vertices.
 * Reads   position_local (the step before the last), position and pose (the last), pose_now.
 * Writes  position_out: pose_now(lerp(position_local, pose^-1(position), alpha)), w of position.
 * Why     fixed steps shown at another rate stutter. Interpolating in the root's frame leaves hair
 *         one step late against itself but never against the head.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_output(const uint item_count, const plait_output_params params,
                           __global const float4* position_local, __global const float4* position,
                           __global const float4* pose, __global const float4* pose_now,
                           __global float4* position_out) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = item / params.vertex_stride;
    const float4 x = position[item];
    const vec3 last = pose_apply_inverse(pose_load(pose, strand), unpack3(x));
    const vec3 before = scale3(unpack3(position_local[item]), 1.0f - params.alpha);
    const vec3 between = axpy3(params.alpha, last, before);
    position_out[item] = pack3(pose_apply(pose_load(pose_now, strand), between), x.w);
}
