/* mesh_take: where the caller puts the vertices of a mesh, from a buffer as the caller has it.
 *
 * Items   vertices of the mesh.
 * Reads   mesh_taken, mesh_at.
 * Writes  mesh_target: what is taken times params.scale, to the groom's units.
 * Source  ours. What is not finite, or too far away, is no place: the vertex stays where it is.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "plait/params.h"

static inline int is_place(float x) {
    return fabs(x) <= PLAIT_MESH_MOST_COORDINATE; /* NaN is not */
}

__kernel void plait_mesh_take(const uint item_count, const plait_mesh_take_params params,
                              __global const float* mesh_taken, __global const float4* mesh_at,
                              __global float4* mesh_target) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    __global const float* taken = mesh_taken + (size_t)item * params.words;
    const float x = taken[0], y = taken[1], z = taken[2];
    const float4 at = mesh_at[item];
    mesh_target[item] = is_place(x) && is_place(y) && is_place(z)
                            ? (float4)(params.scale * (float3)(x, y, z), 0.0f)
                            : (float4)(at.x, at.y, at.z, 0.0f);
}
