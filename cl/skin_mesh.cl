/* skin_mesh: the pose of each strand's root from the triangle of a mesh that it is bound to.
 *
 * Items   strands.
 * Reads   skin_corner, skin_rest, skin_at, rest (of the root).
 * Writes  pose.
 * Source  the deformation of a triangle, whose normal keeps its length (Sumner & Popovic 2004); the
 *         rotation closest to it: common/skin.clh.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/skin.clh"

/* Of length 1, or 0 where the triangle has no area. */
static inline float3 unit_normal(float3 ab, float3 ac) {
    const float3 n = cross(ab, ac);
    const float size = sqrt(dot3(n, n));
    return size > 0.0f ? n / size : (float3)(0.0f);
}

__kernel void plait_skin_mesh(const uint item_count, const plait_layout_params params,
                              __global const uint* skin_corner, __global const float4* skin_rest,
                              __global const float4* skin_at, __global const float4* rest,
                              __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    __global const uint* corner = skin_corner + 3 * (size_t)strand;
    const float3 a = skin_rest[corner[0]].xyz, ab = skin_rest[corner[1]].xyz - a,
                 ac = skin_rest[corner[2]].xyz - a;
    const float3 a_now = skin_at[corner[0]].xyz, ab_now = skin_at[corner[1]].xyz - a_now,
                 ac_now = skin_at[corner[2]].xyz - a_now;
    const float3 n = unit_normal(ab, ac), n_now = unit_normal(ab_now, ac_now);
    /* rows of [ab ac n]^-1 */
    const float area = dot3(n, cross(ab, ac));
    const float3 along_ab = cross(ac, n) / area, along_ac = cross(n, ab) / area;
    const float3 r0 = ab_now.x * along_ab + ac_now.x * along_ac + n_now.x * n;
    const float3 r1 = ab_now.y * along_ab + ac_now.y * along_ac + n_now.y * n;
    const float3 r2 = ab_now.z * along_ab + ac_now.z * along_ac + n_now.z * n;
    skin_store(pose, strand, (float4)(r0, a_now.x - dot3(r0, a)),
               (float4)(r1, a_now.y - dot3(r1, a)), (float4)(r2, a_now.z - dot3(r2, a)),
               rest[(size_t)strand * params.vertex_stride].xyz);
}
