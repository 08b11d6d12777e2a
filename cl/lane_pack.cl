/* lane_pack: positions and their Verlet history back to lane state, after the inter-hair step or
 * the user changed them. Orientations are kept.
 *
 * Items   vertices of the lanes in use.
 * Reads   lane_strand, vertex_count, position, position_prev.
 * Writes  lane_x, lane_v of every vertex but the root.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_pack(const uint item_count, const plait_lane_layout_params params,
                              __global const uint* lane_strand, __global const uint* vertex_count,
                              __global const float4* position, __global const float4* position_prev,
                              __global float* lane_x, __global float* lane_v) {
    const uint item = get_global_id(0), row = item % params.vertex_stride;
    if (item >= item_count || row == 0)
        return;
    const uint strand = lane_strand_of(lane_strand, item / params.vertex_stride);
    if (row >= vertex_count[strand])
        return;
    const size_t vertex = (size_t)strand * params.vertex_stride + row;
    const float3 root = position[vertex - row].xyz, x = position[vertex].xyz;
    const size_t here = lane_element(item, params.vertex_stride, params.tile);
    lane_write(lane_x, here, params.tile, x - root);
    lane_write(lane_v, here, params.tile, (x - position_prev[vertex].xyz) / params.h);
}
