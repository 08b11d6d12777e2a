/* lane_pack: positions and their Verlet history back to lane state, after the inter-hair step or
 * the user changed them. Orientations are kept.
 *
 * Items   vertices.
 * Reads   vertex_count, position, position_prev.
 * Writes  lane_x, lane_v of every vertex but the root.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_pack(const uint item_count, const plait_lane_layout_params params,
                              __global const uint* vertex_count, __global const float4* position,
                              __global const float4* position_prev, __global float* lane_x,
                              __global float* lane_v) {
    const uint item = get_global_id(0), row = item % params.vertex_stride;
    if (item >= item_count || row == 0 || row >= vertex_count[item / params.vertex_stride])
        return;
    const float3 root = position[item - row].xyz, x = position[item].xyz;
    const size_t here = lane_element(item, params.vertex_stride, params.tile);
    lane_write(lane_x, here, params.tile, x - root);
    lane_write(lane_v, here, params.tile, (x - position_prev[item].xyz) / params.h);
}
