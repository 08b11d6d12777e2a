/* accelerate: what pulls at single vertices, m/s^2, beside gravity and air: a place for a caller's
 * own kernel, and not in the schedule without one. Ours knows of nothing that pulls.
 *
 * Items   vertices.
 * Reads   vertex_count, position, position_prev: of the step before.
 * Moves   acceleration: what was there before, the caller's or that of the step before.
 */
#include "plait/params.h"

__kernel void plait_accelerate(const uint item_count, const plait_accelerate_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global const float4* position_prev,
                               __global float4* acceleration) {
    const uint item = get_global_id(0);
    if (item < item_count)
        acceleration[item] = (float4)(0.0f);
}
