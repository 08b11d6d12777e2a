/* level_wake: strands that followed, and are stepped from now on.
 *
 * Items   strands, in lanes strand_first and on.
 * Reads   lane_strand, rest, pose_before, pose, wake_from, wake_to, position, lane_rest.
 * Writes  lane_x, lane_v, lane_q, lane_q_before, lane_normal_force, and the step before where BDF2
 *         keeps it, of these strands.
 * Source  ours. Vertices are where they were shown, as far as segments keep their lengths at rest;
 *         v is what the guides alone moved them by in the step: bodies that turned them did not throw
 *         them. q_i = Q_i S_i, S_i the product of the joints at rest and Q_i the turn of segment i
 *         since then, carried along the strand as in guide_turns: so twist is that at rest.
 * Changed q_before and x_before lie as far behind as strands have moved in a substep at this rate.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_scalar.clh"
#include "base/pose.clh"

#if PLAIT_LANES == 1
static inline void wake_write4(__global float* data, size_t element, uint tile, quat q) {
    data[element] = q.x;
    data[element + tile] = q.y;
    data[element + 2 * tile] = q.z;
    data[element + 3 * tile] = q.w;
}

static inline quat wake_read4(__global const float* data, size_t element, uint tile) {
    return quat_of(data[element], data[element + tile], data[element + 2 * tile],
                   data[element + 3 * tile]);
}
#endif

static inline vec3 wake_segment(__global const float4* row, uint i) {
    return sub3(unpack3(row[i + 1]), unpack3(row[i]));
}

/* `turn` of the segment before, carried to this one. */
static inline quat wake_turn(quat turn, vec3 at_rest, vec3 now) {
    return normalizeq(mulq_by_parts(quat_between(rotate3(turn, at_rest), now), turn));
}

__kernel void plait_level_wake(const uint item_count, const plait_level_wake_params params,
                               __global const uint* lane_strand, __global const float4* rest,
                               __global const float4* pose_before, __global const float4* pose,
                               __global const float4* wake_from, __global const float4* wake_to,
                               __global const float4* position, __global const float* lane_rest,
                               __global float* lane_x, __global float* lane_v,
                               __global float* lane_q, __global float* lane_q_before,
                               __global float* lane_x_before, __global float* lane_v_before,
                               __global float* lane_normal_force) {
    const uint item = get_global_id(0), stride = params.vertex_stride, tile = params.tile;
    if (item >= item_count)
        return;
    const uint lane = params.strand_first + item, strand = lane_strand_of(lane_strand, lane);
    const size_t row = (size_t)strand * params.row_stride;
    const pose_t before = pose_load(pose_before, strand), now = pose_load(pose, strand);
    const vec3 origin = unpack3(rest[row]), root = pose_apply(now, origin);
    const vec3 root_v = div3(sub3(root, pose_apply(before, origin)), params.step);
    const vec3 from_root = unpack3(wake_from[row]), to_root = unpack3(wake_to[row]);
    quat turn = now.q, turn_before = before.q, joints = identityq();
    vec3 way = zero3(); /* from the root */
    for (uint i = 0; i < stride; ++i) {
        const size_t three = lane_row(lane, i, 3, stride, tile);
        const size_t four = lane_row(lane, i, 4, stride, tile);
        const vec3 moved = sub3(sub3(unpack3(wake_to[row + i]), to_root),
                                sub3(unpack3(wake_from[row + i]), from_root));
        const vec3 v = div3(moved, params.step); /* relative to the root */
        const vec3 x = i > 0 ? way : root, v_all = i > 0 ? add3(root_v, v) : root_v;
        lane_write3(lane_x, three, tile, x);
        lane_write3(lane_v, three, tile, v_all);
        lane_normal_force[lane_row(lane, i, 1, stride, tile)] = 0.0f;
        if (params.history) {
            lane_write3(lane_x_before, three, tile, axpy3(-params.h, i > 0 ? v : root_v, x));
            lane_write3(lane_v_before, three, tile, v_all);
        }
        if (i + 1 < stride) {
            const vec3 at_rest = wake_segment(rest + row, i);
            const vec3 segment = wake_segment(position + row, i);
            turn = wake_turn(turn, at_rest, segment);
            turn_before = wake_turn(turn_before, at_rest, wake_segment(wake_from + row, i));
            way = axpy3(length3(at_rest), normalize3(segment), way);
        }
        joints = mulq(joints, wake_read4(lane_rest, four, tile));
        const quat q = mulq(turn, joints);
        wake_write4(lane_q, four, tile, q);
        wake_write4(lane_q_before, four, tile,
                    nlerpq(q, mulq(turn_before, joints), params.h / params.step));
    }
}
