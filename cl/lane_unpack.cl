/* lane_unpack: lane state to positions in the world and their Verlet history, which display, the
 * inter-hair grid and interop read.
 *
 * Items   vertices of the lanes in use.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Writes  position (w is kept), position_prev = position - h v.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_unpack(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_strand, __global const uint* vertex_count,
                                __global const float* lane_x, __global const float* lane_v,
                                __global float4* position, __global float4* position_prev) {
    const uint item = get_global_id(0), row = item % params.vertex_stride;
    if (item >= item_count)
        return;
    const uint strand = lane_strand_of(lane_strand, item / params.vertex_stride);
    if (row >= vertex_count[strand])
        return;
    const size_t vertex = (size_t)strand * params.vertex_stride + row;
    const size_t root = lane_element(item - row, params.vertex_stride, params.tile);
    const size_t here = lane_element(item, params.vertex_stride, params.tile);
    float3 x = lane_read(lane_x, root, params.tile);
    if (row > 0)
        x += lane_read(lane_x, here, params.tile);
    const float3 v = lane_read(lane_v, here, params.tile);
    const float w = position[vertex].w;
    position[vertex] = (float4)(x, w);
    position_prev[vertex] = (float4)(x - params.h * v, w);
}
