/* lane_unpack: lane state to positions in the world and their Verlet history, which display, the
 * inter-hair grid and interop read.
 *
 * Items   vertices of the lanes in use.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Writes  position, position_prev = position - h v; w 0 at the root, which is pinned, else 1.
 *         Strands lie in another order there than in lanes: to read w would be to wait for it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_unpack(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_strand, __global const uint* vertex_count,
                                __global const float* lane_x, __global const float* lane_v,
                                __global float4* position, __global float4* position_prev) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    const uint lane = item / stride, row = item % stride;
    if (item >= item_count)
        return;
    const uint strand = lane_strand_of(lane_strand, lane);
    if (row >= vertex_count[strand])
        return;
    const size_t vertex = (size_t)strand * stride + row;
    const size_t here = lane_row(lane, row, 3, stride, tile);
    float3 x = lane_read(lane_x, lane_row(lane, 0, 3, stride, tile), tile);
    if (row > 0)
        x += lane_read(lane_x, here, tile);
    const float3 v = lane_read(lane_v, here, tile);
    const float w = row == 0 ? 0.0f : 1.0f;
    position[vertex] = (float4)(x, w);
    position_prev[vertex] = (float4)(x - params.h * v, w);
}
