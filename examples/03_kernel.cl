/* A gravity well: every vertex is drawn towards a point, a = G r / (r^2 + s^2)^(3/2), r from the
 * vertex to the point. What `value` holds is between this file and 03_kernel.c:
 *   0, 1, 2   the point, m, in the world
 *   3         G, m^3/s^2
 *   4         s, m: how near the pull stops growing
 * The headers that stages share are part of plait, and so is the signature
 * (docs/stages/push.md#accelerate). */
#include "plait/params.h"

__kernel void plait_accelerate(const uint item_count, const plait_accelerate_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global const float4* position_prev,
                               __global float4* acceleration) {
    const uint vertex = get_global_id(0);
    if (vertex >= item_count) /* there may be more work-items than vertices */
        return;
    const float3 r = vload3(0, params.value) - position[vertex].xyz;
    const float squared = dot(r, r) + params.value[4] * params.value[4];
    acceleration[vertex] = (float4)(params.value[3] / (squared * sqrt(squared)) * r, 0.0f);
}
