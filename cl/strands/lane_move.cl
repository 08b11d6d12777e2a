/* lane_move: strands from one buffer in the lane layout to another, bit by bit.
 *
 * Items   strands that move.
 * Reads   lane_slot, lane_from.
 * Writes  lane_to, of these strands.
 */
#include "base/lane_scalar.clh"
#include "plait/params.h"

__kernel void plait_lane_move(const uint item_count, const plait_lane_move_params params,
                              __global const uint* lane_slot, __global const float* lane_from,
                              __global float* lane_to) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const size_t from = lane_row(lane_slot[2 * item], 0, params.components, stride, tile);
    const size_t to = lane_row(lane_slot[2 * item + 1], 0, params.components, stride, tile);
    for (size_t i = 0; i < (size_t)stride * params.components; ++i)
        lane_to[to + i * tile] = lane_from[from + i * tile];
}
