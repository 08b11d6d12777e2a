/* integrate: Verlet step, and the global shape constraint where its stiffness is not 0.
 *
 * Items   vertices.
 * Reads   rest, vertex_count, pose, acceleration.
 * Moves   position; position_prev and position_prev2 shift by one step.
 * Source  TressFX 4.1, integration and global shape; Han & Harada 2012, section 3.
 *         x' = x + exp(-60 d h) (x - x_prev) + h^2 (g + a); pinned vertices go to their skinned
 *         rest.
 * Changed h may be any step: the published damping factor is per frame and takes 60 Hz for granted.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pose.clh"
#include "common/shape.clh"
#include "common/strand.clh"
#include "plait/constants.h"

static inline float3 verlet(const plait_integrate_params* params, float3 pull, float3 x,
                            float3 prev) {
    const float kept = exp(-PLAIT_DAMPING_RATE * params->damping * params->h);
    return x + kept * (x - prev) + (params->h * params->h) * pull;
}

__kernel void plait_integrate(const uint item_count, const plait_integrate_params params,
                              __global const float4* rest, __global const uint* vertex_count,
                              __global const float4* pose, __global const float4* acceleration,
                              __global float4* position, __global float4* position_prev,
                              __global float4* position_prev2) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = item / params.vertex_stride;
    const uint vertex = item % params.vertex_stride;
    const uint count = vertex_count[strand];
    if (vertex >= count)
        return;
    const float4 x = position[item];
    const float4 prev = position_prev[item];
    float3 pull = (float3)(params.gravity[0], params.gravity[1], params.gravity[2]);
    if (params.accelerates)
        pull += checked_acceleration(acceleration[item].xyz);
    float3 moved = pose_apply(pose_load(pose, strand), rest[item].xyz);
    if (is_free(x))
        moved = global_shape(verlet(&params, pull, x.xyz, prev.xyz), moved, params.global_stiffness,
                             params.global_range, vertex, count);
    position[item] = (float4)(moved, x.w);
    position_prev[item] = x;
    position_prev2[item] = prev;
}
