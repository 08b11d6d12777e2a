/* lane_unpack: lane state to positions in the world and their Verlet history, which display, the
 * inter-hair grid and interop read.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Writes  position, position_prev = position - h v; w 0 at the root, which is pinned, else 1.
 *         Strands lie in another order there than in lanes: to read w would be to wait for it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_step.clh"

__kernel void plait_lane_unpack(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_strand, __global const uint* vertex_count,
                                __global const real* lane_x, __global const real* lane_v,
                                __global float4* position, __global float4* position_prev) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const uint lanes = lane_place_strands(place, item_count);
    const vec3 root = load3(lane_x, place, 0);
    for (uint i = 0; i < PLAIT_VERTICES; ++i) {
        const vec3 x = i > 0 ? add3(root, load3(lane_x, place, i)) : root;
        const vec3 v = load3(lane_v, place, i);
        const vec3 before =
            vec3_of(x.x - params.h * v.x, x.y - params.h * v.y, x.z - params.h * v.z);
        const float w = i == 0 ? 0.0f : 1.0f;
        for (uint k = 0; k < lanes; ++k) {
            if (i >= vertex_count[strands.at[k]])
                continue;
            const size_t vertex = (size_t)strands.at[k] * PLAIT_VERTICES + i;
            position[vertex] = (float4)(LANE(x.x, k), LANE(x.y, k), LANE(x.z, k), w);
            position_prev[vertex] =
                (float4)(LANE(before.x, k), LANE(before.y, k), LANE(before.z, k), w);
        }
    }
}
