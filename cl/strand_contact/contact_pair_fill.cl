/* contact_pair_fill: the segments of every cell, one after the other, and where they are and move to.
 *
 * Items   vertices; those that begin a segment are put.
 * Reads   vertex_count, position, position_prev.
 * Writes  cell_segment, cell_line; cell_end: from where a cell begins to where it ends. In which order
 *         segments of one cell lie differs from run to run; nothing that is found in them does.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "strand_contact/pair.clh"

static inline void pair_put3(__global float* line, size_t stride, vec3 value) {
    line[0] = value.x;
    line[stride] = value.y;
    line[2 * stride] = value.z;
}

__kernel void plait_contact_pair_fill(const uint item_count, const plait_pair_params params,
                                      __global const uint* vertex_count,
                                      __global const float4* position,
                                      __global const float4* position_prev, __global uint* cell_end,
                                      __global uint* cell_segment, __global float* cell_line) {
    const uint item = get_global_id(0);
    if (item >= item_count || !pair_has_segment(vertex_count, item, params.vertex_stride))
        return;
    const uint cell = pair_number(pair_cell_of_segment(&params, position, item), params.edge_count);
    const uint at = atomic_inc(&cell_end[cell]);
    if (at >= item_count) /* other segments were counted */
        return;
    const segment own = segment_at(position, item);
    const segment_motion motion = segment_motion_at(position, position_prev, item);
    const size_t stride = pair_line_stride(item_count);
    __global float* line = cell_line + at;
    cell_segment[at] = item;
    pair_put3(line + PLAIT_PAIR_MIDDLE * stride, stride, axpy3(0.5f, own.way, own.from));
    pair_put3(line + PLAIT_PAIR_HALF * stride, stride, scale3(fabs(own.way), 0.5f));
    pair_put3(line + PLAIT_PAIR_FROM * stride, stride, own.from);
    pair_put3(line + PLAIT_PAIR_WAY * stride, stride, own.way);
    pair_put3(line + PLAIT_PAIR_MOVES * stride, stride, segment_moves(motion, 0.5f));
    line[PLAIT_PAIR_SPREAD * stride] = 0.5f * length3(motion.change);
    pair_put3(line + PLAIT_PAIR_CHANGE * stride, stride, motion.change);
}
