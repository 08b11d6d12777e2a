/* output: interpolate between the last two finished steps, attached to the roots of now.
 *
 * Items   vertices.
 * Reads   position_local (the step before the last), position and pose (the last), pose_now.
 * Writes  position_out: in the root's frame, from the strand's root, the interpolated direction to the vertex
 *         by the interpolated distance; then where pose_now puts it. w of position.
 * Why     fixed steps shown at another rate stutter. Interpolating in the root's frame leaves hair
 *         one step late against itself but never against the head. A vertex that swings about its root
 *         is shown on the arc. The chord is nearer to the root: where hair lies on the head, inside it.
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
    const uint strand = item / params.vertex_stride, first = strand * params.vertex_stride;
    const float alpha = params.alpha;
    const pose_t pose_last = pose_load(pose, strand);
    const vec3 root_before = unpack3(position_local[first]);
    const vec3 root_last = pose_apply_inverse(pose_last, unpack3(position[first]));
    const float4 x = position[item];
    const vec3 before = sub3(unpack3(position_local[item]), root_before);
    const vec3 last = sub3(pose_apply_inverse(pose_last, unpack3(x)), root_last);

    const vec3 root = axpy3(alpha, root_last, scale3(root_before, 1.0f - alpha));
    const vec3 chord = axpy3(alpha, last, scale3(before, 1.0f - alpha));
    const float near = length3(chord);
    const float far = (1.0f - alpha) * length3(before) + alpha * length3(last);
    /* What all but turns round within a step has no direction in between. */
    const float stretch = near > 0.1f * far ? far / near : 1.0f;
    const vec3 shown = axpy3(stretch, chord, root);
    position_out[item] = pack3(pose_apply(pose_load(pose_now, strand), shown), x.w);
}
