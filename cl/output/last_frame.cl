/* last_frame: keep the positions that are shown, as those of the frame before: motion vectors; and show
 * hair at another size than the groom's.
 *
 * Items   vertices.
 * Reads   position.
 * Writes  position_last_frame: position times params.scale, w kept.
 */
#include "plait/params.h"

__kernel void plait_last_frame(const uint item_count, const plait_last_frame_params params,
                               __global const float4* position,
                               __global float4* position_last_frame) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 x = position[item];
    position_last_frame[item] = (float4)(params.scale * x.xyz, x.w);
}
