/* pair_fill: the segments of every cell, one after the other.
 *
 * Items   vertices; those that begin a segment are put.
 * Reads   vertex_count, position.
 * Writes  cell_segment; cell_end: from where a cell begins to where it ends. In which order segments
 *         of one cell lie differs from run to run; nothing that is found in them does.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pair.clh"

__kernel void plait_pair_fill(const uint item_count, const plait_pair_params params,
                              __global const uint* vertex_count, __global const float4* position,
                              __global uint* cell_end, __global uint* cell_segment) {
    const uint item = get_global_id(0);
    if (item >= item_count || !pair_has_segment(vertex_count, item, params.vertex_stride))
        return;
    const uint at = atomic_inc(&cell_end[pair_cell_of_segment(&params, position, item)]);
    if (at < item_count) /* else other segments were counted */
        cell_segment[at] = item;
}
