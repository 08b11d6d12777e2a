/* pair_count: how many segments have their middle in each cell.
 *
 * Items   vertices; those that begin a segment count.
 * Reads   vertex_count, position.
 * Writes  cell_count, which it adds to.
 * Source  counting sort; cells that repeat in space: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pair.clh"

__kernel void plait_pair_count(const uint item_count, const plait_pair_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global uint* cell_count) {
    const uint item = get_global_id(0);
    if (item >= item_count || !pair_has_segment(vertex_count, item, params.vertex_stride))
        return;
    atomic_inc(&cell_count[pair_cell_of_segment(&params, position, item)]);
}
