/* mesh_advance: the vertices of a mesh at both ends of a fixed step: it begins where the one before ended,
 * and ends at a part of their straight way from where they were to where the caller puts them.
 *
 * Items   vertices of the mesh.
 * Reads   mesh_at, mesh_target, each times a scale, to the groom's units.
 * Moves   mesh_from, mesh_to.
 * Source  ours, as poses go (docs/stages/roots.md#roots).
 */
#pragma OPENCL FP_CONTRACT OFF
#include "plait/params.h"

__kernel void plait_mesh_advance(const uint item_count, const plait_mesh_advance_params params,
                                 __global const float4* mesh_at, __global const float4* mesh_target,
                                 __global float4* mesh_from, __global float4* mesh_to) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const size_t vertex = (size_t)params.begins + item;
    const float4 at = params.at_scale * mesh_at[item];
    const float4 target = params.target_scale * mesh_target[item];
    mesh_from[vertex] = mesh_to[vertex];
    /* at the end to the bit */
    mesh_to[vertex] = params.part < 1.0f ? at + params.part * (target - at) : target;
}
