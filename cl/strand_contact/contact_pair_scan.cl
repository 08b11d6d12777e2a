/* contact_pair_scan: where in a list of all segments, cell after cell, those of each cell begin.
 *
 * Items   one, of a work-group of any size.
 * Reads   cell_count.
 * Writes  cell_end: the sum of the counts before.
 */
#include "plait/params.h"

__kernel void plait_contact_pair_scan(const uint item_count,
                                      const plait_contact_pair_scan_params params,
                                      __global const uint* cell_count, __global uint* cell_end,
                                      __local uint* partial) {
    const uint cells = params.edge_count * params.edge_count * params.edge_count;
    const uint item = get_local_id(0), size = get_local_size(0);
    const uint share = get_group_id(0) < item_count ? (cells + size - 1u) / size : 0u;
    const uint first = min(item * share, cells), end = min(first + share, cells);
    uint sum = 0u;
    for (uint cell = first; cell < end; ++cell)
        sum += cell_count[cell];
    partial[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    uint begin = 0u;
    for (uint before = 0u; before < item; ++before)
        begin += partial[before];
    for (uint cell = first; cell < end; ++cell) {
        cell_end[cell] = begin;
        begin += cell_count[cell];
    }
}
