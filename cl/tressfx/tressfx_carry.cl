/* tressfx_carry: carries positions and both histories along with a frame whose motion hair does not feel,
 * x <- q*x + t.
 *
 * Items   vertices.
 * Moves   position, position_prev, position_prev2.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"

__kernel void plait_tressfx_carry(const uint item_count, const plait_carry_params params,
                                  __global float4* position, __global float4* position_prev,
                                  __global float4* position_prev2) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const pose_t motion = {vload4(0, params.q), unpack3(vload4(0, params.t))};
    const float4 x = position[item], prev = position_prev[item], prev2 = position_prev2[item];
    position[item] = pack3(pose_apply(motion, unpack3(x)), x.w);
    position_prev[item] = pack3(pose_apply(motion, unpack3(prev)), prev.w);
    position_prev2[item] = pack3(pose_apply(motion, unpack3(prev2)), prev2.w);
}
