/* global_shape: the global shape constraint on its own, for the order shock_before_global.
 *
 * Items   vertices.
 * Reads   rest, vertex_count, pose.
 * Moves   position: x <- x + s (x0 - x) for the first `range` of each strand, x0 the skinned rest.
 * Source  Han & Harada 2012, section 3; TressFX 4.1.
 * Changed a stage of its own, so that it can run after velocity_shock: published, it acts before,
 *         and the shock then carries vertices away from the goal they were just given.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/pose.clh"
#include "base/strand.clh"
#include "tressfx/shape.clh"

__kernel void plait_global_shape(const uint item_count, const plait_global_shape_params params,
                                 __global const float4* rest, __global const uint* vertex_count,
                                 __global const float4* pose, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = item / params.vertex_stride;
    const uint vertex = item % params.vertex_stride;
    const uint count = vertex_count[strand];
    const float4 x = position[item];
    if (vertex >= count || !is_free(x))
        return;
    const vec3 goal = pose_apply(pose_load(pose, strand), unpack3(rest[item]));
    const vec3 moved =
        global_shape(unpack3(x), goal, params.stiffness, params.range, vertex, count);
    position[item] = pack3(moved, x.w);
}
