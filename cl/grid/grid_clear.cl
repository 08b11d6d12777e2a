/* grid_clear: fill words of a grid buffer, with PLAIT_SLOT_EMPTY or 0.
 *
 * Items   32-bit words.
 * Writes  words.
 */
#include "plait/params.h"

__kernel void plait_grid_clear(const uint item_count, const plait_grid_clear_params params,
                               __global uint* words) {
    const uint item = get_global_id(0);
    if (item < item_count)
        words[item] = params.value;
}
