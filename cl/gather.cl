/* gather: rows of chosen strands, side by side, for stages that work on these strands alone.
 *
 * Items   strands that are chosen.
 * Reads   lane_strand, rows.
 * Writes  gathered.
 */
#include "plait/params.h"

__kernel void plait_gather(const uint item_count, const plait_layout_params params,
                           __global const uint* lane_strand, __global const float4* rows,
                           __global float4* gathered) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const size_t from = (size_t)lane_strand[item] * params.vertex_stride;
    const size_t to = (size_t)item * params.vertex_stride;
    for (uint i = 0; i < params.vertex_stride; ++i)
        gathered[to + i] = rows[from + i];
}
