/* contact_pair_count: how many segments have their middle in each cell, and how far vertices move.
 *
 * Items   vertices; those that begin a segment count.
 * Reads   vertex_count, position, position_prev.
 * Writes  cell_count, which it adds to; cell_moves, which it raises.
 * Source  counting sort; cells that repeat in space: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "strand_contact/pair.clh"

static inline float pair_moves(__global const float4* position, __global const float4* before,
                               uint vertex) {
    return length3(unpack3(position[vertex]) - unpack3(before[vertex]));
}

__kernel void plait_contact_pair_count(const uint item_count, const plait_pair_params params,
                                       __global const uint* vertex_count,
                                       __global const float4* position,
                                       __global const float4* position_prev,
                                       __global uint* cell_count, __global uint* cell_moves) {
    const uint item = get_global_id(0);
    if (item >= item_count || !pair_has_segment(vertex_count, item, params.vertex_stride))
        return;
    const int3 cell = pair_cell_of_segment(&params, position, item);
    atomic_inc(&cell_count[pair_number(cell, params.edge_count)]);
    const float moves = fmax(pair_moves(position, position_prev, item),
                             pair_moves(position, position_prev, item + 1));
    const int3 block = (int3)(pair_block_of(cell.x), pair_block_of(cell.y), pair_block_of(cell.z));
    /* bits of floats above 0 are in the order of these */
    atomic_max(&cell_moves[pair_number(block, pair_blocks(&params))], as_uint(moves));
}
