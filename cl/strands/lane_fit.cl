/* lane_fit: with `lengths` takes every stretched segment of a strand to its length, its direction
 * kept, and all that follows along; with `history` the step before to where velocities come from.
 *
 * Items   strands.
 * Reads   lane_slot, lane_material, lane_v, lane_x.
 * Writes  lane_x, lane_x_before, lane_v_before, of these strands.
 * Source  ours: x_i += sum over segments j < i of (l_j - |e_j|) e_j/|e_j|, e the old edges;
 *         x_before = x - h v, both relative to the root, of which row 0 says where it is and how
 *         fast. A strand that is not stretched keeps its bits.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_scalar.clh"
#include "plait/constants.h"
#include "plait/params.h"

/* What an edge lacks of its length. */
static inline vec3 to_length(vec3 edge, float length) {
    const float now = length3(edge);
    if (fabs(now - length) <= PLAIT_LANE_FIT_TOLERANCE * length)
        return zero3();
    return sub3(scale3(normalize3(edge), length), edge);
}

__kernel void plait_lane_fit(const uint item_count, const plait_lane_fit_params params,
                             __global const uint* lane_slot, __global const float* lane_material,
                             __global const float* lane_v, __global float* lane_x,
                             __global float* lane_x_before, __global float* lane_v_before) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const uint lane = lane_slot[2 * item + 1];
    const vec3 root_v = lane_read3(lane_v, lane_row(lane, 0, 3, stride, tile), tile);
    vec3 old = zero3(), shift = old;
    for (uint i = 0; i < stride; ++i) {
        const size_t row = lane_row(lane, i, 3, stride, tile);
        const vec3 v = lane_read3(lane_v, row, tile);
        const vec3 moved = i > 0 ? sub3(v, root_v) : v;
        vec3 x = lane_read3(lane_x, row, tile);
        if (i > 0 && params.lengths) {
            const size_t before =
                lane_row(lane, i - 1, PLAIT_LANE_MATERIAL_COMPONENTS, stride, tile);
            const float length = lane_material[before + PLAIT_LANE_LENGTH * tile];
            shift = add3(shift, to_length(sub3(x, old), length));
            old = x;
            x = add3(x, shift);
            lane_write3(lane_x, row, tile, x);
        }
        if (params.history) {
            lane_write3(lane_x_before, row, tile, axpy3(-params.h, moved, x));
            lane_write3(lane_v_before, row, tile, v);
        }
    }
}
