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
#include "base/pose.clh"
#include "base/strand.clh"
#include "plait/constants.h"
#include "push/acceleration.clh"
#include "tressfx/shape.clh"

static inline vec3 verlet(const plait_integrate_params* params, vec3 pull, vec3 x, vec3 prev) {
    const float kept = exp(-PLAIT_DAMPING_RATE * params->damping * params->h);
    return axpy3(params->h * params->h, pull, axpy3(kept, sub3(x, prev), x));
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
    vec3 pull = vec3_of(params.gravity[0], params.gravity[1], params.gravity[2]);
    if (params.accelerates)
        pull = add3(pull, allowed_acceleration(unpack3(acceleration[item])));
    vec3 moved = pose_apply(pose_load(pose, strand), unpack3(rest[item]));
    if (is_free(x))
        moved = global_shape(verlet(&params, pull, unpack3(x), unpack3(prev)), moved,
                             params.global_stiffness, params.global_range, vertex, count);
    position[item] = pack3(moved, x.w);
    position_prev[item] = x;
    position_prev2[item] = prev;
}
