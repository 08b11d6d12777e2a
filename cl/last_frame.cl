/* last_frame: keep the positions that are shown, as those of the frame before: motion vectors.
 *
 * Items   vertices.
 * Reads   position.
 * Writes  position_last_frame.
 */
#include "plait/params.h"

__kernel void plait_last_frame(const uint item_count, const plait_layout_params params,
                               __global const float4* position,
                               __global float4* position_last_frame) {
    const uint item = get_global_id(0);
    if (item < item_count)
        position_last_frame[item] = position[item];
}
