/* lane_orient: orientations of a strand that has had none, from its positions, and those of the
 * step before, from its velocities.
 *
 * Items   strands.
 * Reads   lane_slot, lane_strand, pose, lane_rest, lane_x, lane_v.
 * Writes  lane_q, lane_q_before, of these strands.
 * Source  Bergou et al. 2008: parallel transport carries a frame along a curve without twist. Here
 *         the rest rotation of each joint comes first, and what is left is the shortest turn onto
 *         the segment: of all frames that lie along it, the one with the least energy in the joint.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_scalar.clh"
#include "common/quat.clh"
#include "plait/params.h"

static inline float4 rotation_at(__global const float* data, size_t element, uint tile) {
    return (float4)(data[element], data[element + tile], data[element + 2 * tile],
                    data[element + 3 * tile]);
}
static inline void put_rotation(__global float* data, size_t element, uint tile, float4 q) {
    data[element] = q.x;
    data[element + tile] = q.y;
    data[element + 2 * tile] = q.z;
    data[element + 3 * tile] = q.w;
}

/* `expected` turned so that its x axis lies along `edge`. */
static inline float4 laid_along(float4 expected, float3 edge) {
    const float3 director = quat_rotate(expected, (float3)(1.0f, 0.0f, 0.0f));
    return quat_normalize(quat_mul(quat_between(director, edge), expected));
}

__kernel void plait_lane_orient(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_slot, __global const uint* lane_strand,
                                __global const float4* pose, __global const float* lane_rest,
                                __global const float* lane_x, __global const float* lane_v,
                                __global float* lane_q, __global float* lane_q_before) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const uint lane = lane_slot[2 * item + 1];
    float4 q = pose[(size_t)lane_strand_of(lane_strand, lane) * PLAIT_POSE_STRIDE], before = q;
    float3 x = (float3)(0.0f), v = lane_read(lane_v, lane_row(lane, 0, 3, stride, tile), tile);
    for (uint i = 0; i < stride; ++i) {
        const size_t row = lane_row(lane, i, 4, stride, tile);
        const float4 rest = rotation_at(lane_rest, row, tile);
        float3 edge = (float3)(0.0f), edge_before = edge;
        if (i + 1 < stride) {
            const size_t next = lane_row(lane, i + 1, 3, stride, tile);
            const float3 x_next = lane_read(lane_x, next, tile);
            const float3 v_next = lane_read(lane_v, next, tile);
            edge = x_next - x;
            edge_before = edge - params.h * (v_next - v);
            x = x_next;
            v = v_next;
        }
        q = laid_along(quat_mul(q, rest), edge);
        before = laid_along(quat_mul(before, rest), edge_before);
        put_rotation(lane_q, row, tile, q);
        put_rotation(lane_q_before, row, tile, before);
    }
}
