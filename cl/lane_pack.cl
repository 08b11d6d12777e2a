/* lane_pack: positions and their Verlet history back to lane state, after the inter-hair step or
 * the user changed them. Orientations are kept.
 *
 * Items   vertices of the lanes in use.
 * Reads   lane_strand, vertex_count, position, position_prev.
 * Moves   lane_x, lane_v, with BDF2 lane_v_before, of every vertex but the root.
 * Source  ours: what changed the velocity changes that of the step before by as much. BDF2, which
 *         goes on from (4v - v_before)/3, would else make 3/2 of it in the end.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_pack(const uint item_count, const plait_lane_history_params params,
                              __global const uint* lane_strand, __global const uint* vertex_count,
                              __global const float4* position, __global const float4* position_prev,
                              __global float* lane_x, __global float* lane_v,
                              __global float* lane_v_before) {
    const uint item = get_global_id(0), row = item % params.vertex_stride;
    if (item >= item_count || row == 0)
        return;
    const uint strand = lane_strand_of(lane_strand, item / params.vertex_stride);
    if (row >= vertex_count[strand])
        return;
    const size_t vertex = (size_t)strand * params.row_stride + row;
    const vec3 root = unpack3(position[vertex - row]), x = unpack3(position[vertex]);
    const size_t here = lane_element(item, params.vertex_stride, params.tile);
    lane_write3(lane_x, here, params.tile, sub3(x, root));
    const vec3 v = div3(sub3(x, unpack3(position_prev[vertex])), params.h);
    if (params.history) {
        const vec3 gained = sub3(v, lane_read3(lane_v, here, params.tile));
        lane_write3(lane_v_before, here, params.tile,
                    add3(lane_read3(lane_v_before, here, params.tile), gained));
    }
    lane_write3(lane_v, here, params.tile, v);
}
