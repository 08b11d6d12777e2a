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
#include "base/hash.clh"
#include "grid/grid.clh"

/* Random(p), fig. 4.6: frac(cos(fmod(123456789, 1e-7 + 256 p.r))), p the fractional parts of the
 * vertex' x and y in voxels. The fmod keeps no digits that devices must agree on: kept for parity.
 */
static inline float thesis_random(vec3 g) {
    const float x = g.x - floor(g.x);
    const float y = g.y - floor(g.y);
    const float seed = x * 23.14069263277f + y * 2.66514414269f; /* e^pi, 2^sqrt(2) */
    const float c = cos(fmod(123456789.0f, 1e-7f + 256.0f * seed));
    return c - floor(c);
}

/* Slot of a vertex in its voxel. The integer hash depends on which vertex and frame it is and not
 * on where it is, so vertices that meet in one frame part in the next; (hash * C) >> 32 keeps every
 * capacity as even as powers of two. */
static inline uint slot_of(const plait_grid_params* grid, uint vertex, vec3 g) {
    if (grid->slot_hash == PLAIT_SLOT_HASH_THESIS)
        return min((uint)(thesis_random(g) * (float)grid->capacity), grid->capacity - 1u);
    return mul_hi(pcg(vertex ^ pcg(grid->frame ^ pcg(grid->seed))), grid->capacity);
}

__kernel void plait_grid_slots(const uint item_count, const plait_grid_params params,
                               __global const uint* vertex_count, __global const float4* position,
                               __global uint* grid_slot, __global uint* grid_outside) {
    const uint item = get_global_id(0);
    if (item >= item_count ||
        item % params.vertex_stride >= vertex_count[item / params.vertex_stride])
        return;
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 g = grid_coordinates(&grid, unpack3(position[item]));
    if (grid_contains(&grid, g)) {
        const uint voxel = (uint)grid_voxel_of(&grid, grid_cell_of(&grid, g, 1, PLAIT_TENT_VOXEL));
        grid_slot[(size_t)voxel * params.capacity + slot_of(&params, item, g)] = item;
    } else {
        atomic_inc(grid_outside);
    }
}
