/* grid_density: tent-weighted density of the vertices in a voxel's slots.
 *
 * Items   voxels, one work-group of any size each.
 * Reads   grid_slot, position.
 * Writes  grid_density.
 * Source  Ugurca 2015, eq. 4.1: D = sum (1 - |Px - x|)(1 - |Py - y|)(1 - |Pz - z|), the tent 1 at
 *         the voxel's centre and 0 at its faces.
 * Changed slots are read in parallel and added in a fixed tree: the same slots, the same bits.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/reduce.clh"
#include "grid/grid.clh"

__kernel void plait_grid_density(const uint item_count, const plait_grid_params params,
                                 __global const uint* grid_slot, __global const float4* position,
                                 __global float* grid_density, __local float* partial) {
    const uint voxel = get_group_id(0);
    const uint item = get_local_id(0);
    const uint end = voxel < item_count ? params.capacity : 0u;
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    float sum = 0.0f;
    for (uint slot = item; slot < end; slot += (uint)get_local_size(0)) {
        const uint vertex = grid_slot[(size_t)voxel * params.capacity + slot];
        if (vertex != PLAIT_SLOT_EMPTY)
            sum += grid_tents(grid_coordinates(&grid, unpack3(position[vertex])));
    }
    partial[item] = sum;
    reduce_float(partial);
    if (item == 0u && voxel < item_count)
        grid_density[voxel] = partial[0];
}
