/* lane_fit: BDF2's step before of strands that come from a solve without one.
 *
 * Items   strands.
 * Reads   lane_slot, lane_v, lane_x.
 * Writes  lane_x_before, lane_v_before, of these strands.
 * Source  ours: x_before = x - h v, both relative to the root, of which row 0 says where it is and
 *         how fast.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_fit(const uint item_count, const plait_lane_fit_params params,
                             __global const uint* lane_slot, __global const float* lane_v,
                             __global const float* lane_x, __global float* lane_x_before,
                             __global float* lane_v_before) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const uint lane = lane_slot[2 * item + 1];
    const vec3 root_v = lane_read3(lane_v, lane_row(lane, 0, 3, stride, tile), tile);
    for (uint i = 0; i < stride; ++i) {
        const size_t row = lane_row(lane, i, 3, stride, tile);
        const vec3 v = lane_read3(lane_v, row, tile);
        const vec3 moved = i > 0 ? sub3(v, root_v) : v;
        lane_write3(lane_x_before, row, tile,
                    axpy3(-params.h, moved, lane_read3(lane_x, row, tile)));
        lane_write3(lane_v_before, row, tile, v);
    }
}
