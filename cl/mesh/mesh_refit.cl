/* mesh_refit: boxes of the nodes of a tree over the triangles of a mesh, around both ends of a fixed step
 * and hence the way between them, and how far a vertex under each node goes.
 *
 * Items   nodes of the mesh's tree; those with more than params.least and at most params.most
 *         triangles under them do something. Small ones go over their triangles, greater ones over the
 *         greatest nodes under them whose boxes are there: with 32 times as many at each launch, 25,000
 *         triangles take three.
 * Reads   mesh_first, mesh_under, mesh_triangle, mesh_from, mesh_to.
 * Moves   mesh_box, mesh_way.
 * Writes  mesh_bends, of the mesh.
 * Source  ours. Nodes lie in the order in which one goes down: what is under one follows it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "plait/params.h"

typedef struct {
    float3 low, high; /* m */
    float way;        /* m^2 */
} fit_box;

static inline void fit_cover(fit_box* box, float3 low, float3 high, float way) {
    box->low = fmin(box->low, low);
    box->high = fmax(box->high, high);
    box->way = fmax(box->way, way);
}

static inline void fit_triangles(fit_box* box, __global const uint* triangle, uint number,
                                 __global const float4* from, __global const float4* to) {
    for (uint i = 0; i < number; ++i)
        for (uint k = 0; k < 3; ++k) {
            const uint corner = triangle[PLAIT_MESH_TRIANGLE_STRIDE * (size_t)i + k];
            const float3 a = from[corner].xyz, b = to[corner].xyz, way = b - a;
            fit_cover(box, fmin(a, b), fmax(a, b), way.x * way.x + way.y * way.y + way.z * way.z);
        }
    /* what a place between the two may be off, rounded */
    const float3 far = fmax(fabs(box->low), fabs(box->high));
    const float more = 4.0f * FLT_EPSILON * fmax(far.x, fmax(far.y, far.z));
    box->low -= more;
    box->high += more;
}

__kernel void plait_mesh_refit(const uint item_count, const plait_mesh_refit_params params,
                               __global const uint* mesh_first, __global const uint* mesh_under,
                               __global const uint* mesh_triangle, __global const float4* mesh_from,
                               __global const float4* mesh_to, __global float* mesh_way,
                               __global float4* mesh_box, __global float* mesh_bends) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    __global const uint* first = mesh_first + PLAIT_MESH_FIRST_STRIDE * (size_t)params.mesh;
    const size_t begin = first[PLAIT_MESH_FIRST_NODE];
    __global const uint* under = mesh_under + PLAIT_MESH_UNDER_STRIDE * begin;
    __global const uint* own = under + PLAIT_MESH_UNDER_STRIDE * (size_t)item;
    if (own[1] <= params.least || own[1] > params.most)
        return;
    fit_box box;
    box.low = (float3)(INFINITY, INFINITY, INFINITY);
    box.high = -box.low;
    box.way = 0.0f;
    if (params.least == 0) {
        const size_t triangle = (size_t)first[PLAIT_MESH_FIRST_TRIANGLE] + own[0];
        const size_t vertex = first[PLAIT_MESH_FIRST_VERTEX];
        fit_triangles(&box, mesh_triangle + PLAIT_MESH_TRIANGLE_STRIDE * triangle, own[1],
                      mesh_from + vertex, mesh_to + vertex);
    } else {
        const uint end = item + own[2];
        for (uint node = item + 1; node < end;) {
            __global const uint* at = under + PLAIT_MESH_UNDER_STRIDE * (size_t)node;
            if (at[1] > params.least) {
                ++node;
                continue;
            }
            const size_t there = begin + node;
            fit_cover(&box, mesh_box[2 * there].xyz, mesh_box[2 * there + 1].xyz,
                      mesh_way[there] * mesh_way[there]);
            node += at[2];
        }
    }
    const size_t here = begin + item;
    const float way = sqrt(box.way);
    mesh_box[2 * here] = (float4)(box.low, 0.0f);
    mesh_box[2 * here + 1] = (float4)(box.high, 0.0f);
    mesh_way[here] = way;
    if (item == 0)
        mesh_bends[params.mesh] = way * (1.0f + 1e-6f);
}
