/* grid_slots: find each vertex' voxel and store its index in a random slot of it.
 *
 * Items   vertices.
 * Reads   vertex_count, position.
 * Writes  grid_slot: plain stores, the last writer of a slot wins; so some vertices are not seen by
 *         the voxel in this step, others in the next. grid_outside counts vertices outside.
 * Source  Ugurca 2015, section 4.2, figs. 4.1 and 4.6.
 * Changed outside the grid is counted, not indexed; slot_hash pcg differs per frame and vertex. The
 *         one atomic is for that count, where a vertex is outside.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"

__kernel void plait_grid_slots(const uint item_count, const plait_grid_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global uint* grid_slot, __global uint* grid_outside) {
    const uint item = get_global_id(0);
    if (item >= item_count ||
        item % params.vertex_stride >= vertex_count[item / params.vertex_stride])
        return;
    const float3 g = grid_coordinates(&params, position[item].xyz);
    const uint voxel = world_to_voxel(&params, g);
    if (voxel == GRID_OUTSIDE)
        atomic_inc(grid_outside);
    else
        grid_slot[(size_t)voxel * params.capacity + grid_slot_of(&params, item, g)] = item;
}
