/* skin_mesh: the pose of each strand's root from the triangle of a mesh that it is bound to.
 *
 * Items   strands.
 * Reads   skin_corner, skin_rest, skin_at, rest (of the root).
 * Writes  pose.
 * Source  the deformation of a triangle, whose normal keeps its length (Sumner & Popovic 2004); the
 *         rotation closest to it: roots/skin.clh.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "roots/skin.clh"

/* A triangle's corner, its edges from there and its normal, of length 1, or 0 where it has no area. */
typedef struct {
    vec3 a, ab, ac, n;
} skin_triangle;

static inline skin_triangle triangle_of(__global const float4* at, __global const uint* corner) {
    skin_triangle t;
    t.a = unpack3(at[corner[0]]);
    t.ab = sub3(unpack3(at[corner[1]]), t.a);
    t.ac = sub3(unpack3(at[corner[2]]), t.a);
    const vec3 n = cross3(t.ab, t.ac);
    const float size = length3(n);
    t.n = size > 0.0f ? div3(n, size) : zero3();
    return t;
}

/* The row x ab' + y ac' + z n' of the deformation, and where it takes the corner to `to`. */
static inline float4 row_of(vec3 along_ab, vec3 along_ac, vec3 n, vec3 now, vec3 a, float to) {
    const vec3 row = axpy3(now.z, n, axpy3(now.y, along_ac, scale3(along_ab, now.x)));
    return pack3(row, to - dot3(row, a));
}

__kernel void plait_skin_mesh(const uint item_count, const plait_layout_params params,
                              __global const uint* skin_corner, __global const float4* skin_rest,
                              __global const float4* skin_at, __global const float4* rest,
                              __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    __global const uint* corner = skin_corner + 3 * (size_t)strand;
    const skin_triangle was = triangle_of(skin_rest, corner), is = triangle_of(skin_at, corner);
    /* rows of [ab ac n]^-1, of which the last is n */
    const float area = dot3(was.n, cross3(was.ab, was.ac));
    const vec3 by_ab = div3(cross3(was.ac, was.n), area), by_ac = div3(cross3(was.n, was.ab), area);
    const float4 r0 = row_of(by_ab, by_ac, was.n, vec3_of(is.ab.x, is.ac.x, is.n.x), was.a, is.a.x);
    const float4 r1 = row_of(by_ab, by_ac, was.n, vec3_of(is.ab.y, is.ac.y, is.n.y), was.a, is.a.y);
    const float4 r2 = row_of(by_ab, by_ac, was.n, vec3_of(is.ab.z, is.ac.z, is.n.z), was.a, is.a.z);
    skin_store(pose, strand, r0, r1, r2, unpack3(rest[(size_t)strand * params.vertex_stride]));
}
