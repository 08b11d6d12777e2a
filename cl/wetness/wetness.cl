/* wetness: how wet strands are by now, and what of it their material is scaled by.
 *
 * Items   strands.
 * Reads   wetness_given, wetness_held.
 * Writes  strand_wetness; wetness_held where that has moved away from it.
 * Source  w(t) = w(0) e^(-t/tau), as things dry by diffusion in the end, from what was given and not
 *         from the step before, so that nothing adds up; held until it has moved by
 *         PLAIT_WETNESS_MOVE: ours. Below PLAIT_WETNESS_DRY it is 0, and so is what is held.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "plait/constants.h"
#include "plait/params.h"

__kernel void plait_wetness(const uint item_count, const plait_wetness_params params,
                            __global const float* wetness_given, __global float* strand_wetness,
                            __global float* wetness_held) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    const float left = params.left * wetness_given[strand];
    const float now = left < PLAIT_WETNESS_DRY ? 0.0f : left;
    strand_wetness[strand] = now;
    if (now == 0.0f || fabs(now - wetness_held[strand]) > PLAIT_WETNESS_MOVE)
        wetness_held[strand] = now;
}
