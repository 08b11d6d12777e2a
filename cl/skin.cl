/* skin: the pose of each strand's root from four weighted bones.
 *
 * Items   strands.
 * Reads   bone_matrix, bone_index, bone_weight, rest (of the root).
 * Writes  pose.
 * Source  linear blend skinning; the rotation closest to the blend M in the Frobenius norm is that
 *         of the unit quaternion q with the greatest q.N(M)q (Horn 1987), found by Jacobi's
 *         rotations (1846). Unlike a polar decomposition this gives a rotation for every M, also
 *         where bones mirror or fold.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pose.clh"

#define SKIN_SWEEPS 8        /* of Jacobi's: five reach float32 */
#define SKIN_ROUNDING 1e-14f /* squared share of the diagonal: what is off it is rounding */

/* Turns axes p and q of the symmetric a so that a_pq = 0, and the vectors v with them. */
static inline void jacobi_rotate(float a[4][4], float v[4][4], int p, int q) {
    if (a[p][q] == 0.0f)
        return;
    const float theta = (a[q][q] - a[p][p]) / (2.0f * a[p][q]);
    /* theta^2 may be infinite: t is 0 then */
    const float t = copysign(1.0f, theta) / (fabs(theta) + sqrt(theta * theta + 1.0f));
    const float c = 1.0f / sqrt(t * t + 1.0f), s = t * c;
#pragma unroll
    for (int i = 0; i < 4; ++i) {
        const float ip = a[i][p], iq = a[i][q];
        a[i][p] = c * ip - s * iq;
        a[i][q] = s * ip + c * iq;
    }
#pragma unroll
    for (int i = 0; i < 4; ++i) {
        const float pi = a[p][i], qi = a[q][i];
        a[p][i] = c * pi - s * qi;
        a[q][i] = s * pi + c * qi;
    }
#pragma unroll
    for (int i = 0; i < 4; ++i) {
        const float ip = v[i][p], iq = v[i][q];
        v[i][p] = c * ip - s * iq;
        v[i][q] = s * ip + c * iq;
    }
}

/* The unit quaternion of the rotation closest to the matrix of these rows. */
static inline float4 closest_rotation(float3 r0, float3 r1, float3 r2) {
    const float3 most = fmax(fabs(r0), fmax(fabs(r1), fabs(r2)));
    const float size = fmax(fmax(most.x, most.y), most.z);
    if (!(size > 0.0f))
        return QUAT_IDENTITY;
    r0 /= size;
    r1 /= size;
    r2 /= size;
    /* in the order x, y, z, w */
    float a[4][4] = {{r0.x - r1.y - r2.z, r0.y + r1.x, r0.z + r2.x, r2.y - r1.z},
                     {r0.y + r1.x, r1.y - r0.x - r2.z, r1.z + r2.y, r0.z - r2.x},
                     {r0.z + r2.x, r1.z + r2.y, r2.z - r0.x - r1.y, r1.x - r0.y},
                     {r2.y - r1.z, r0.z - r2.x, r1.x - r0.y, r0.x + r1.y + r2.z}};
    float v[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (int sweep = 0; sweep < SKIN_SWEEPS; ++sweep) {
        float off = 0.0f, on = 0.0f;
#pragma unroll
        for (int p = 0; p < 4; ++p) {
            on += a[p][p] * a[p][p];
#pragma unroll
            for (int q = p + 1; q < 4; ++q)
                off += a[p][q] * a[p][q];
        }
        if (!(off > SKIN_ROUNDING * on))
            break;
#pragma unroll
        for (int p = 0; p < 3; ++p)
#pragma unroll
            for (int q = p + 1; q < 4; ++q)
                jacobi_rotate(a, v, p, q);
    }
    float most_pull = a[0][0];
    float4 best = (float4)(v[0][0], v[1][0], v[2][0], v[3][0]);
#pragma unroll
    for (int i = 1; i < 4; ++i) {
        const bool more = a[i][i] > most_pull;
        most_pull = more ? a[i][i] : most_pull;
        best = more ? (float4)(v[0][i], v[1][i], v[2][i], v[3][i]) : best;
    }
    return quat_normalize(best);
}

__kernel void plait_skin(const uint item_count, const plait_layout_params params,
                         __global const float4* bone_matrix, __global const uint* bone_index,
                         __global const float* bone_weight, __global const float4* rest,
                         __global float4* pose) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    float4 r0 = (float4)(0.0f), r1 = r0, r2 = r0;
    for (uint i = 4 * strand; i < 4 * strand + 4; ++i) {
        const float weight = bone_weight[i];
        __global const float4* bone = bone_matrix + 3 * (size_t)bone_index[i];
        if (weight > 0.0f) {
            r0 += weight * bone[0];
            r1 += weight * bone[1];
            r2 += weight * bone[2];
        }
    }
    const float3 root = rest[(size_t)strand * params.vertex_stride].xyz;
    pose_t result;
    result.q = closest_rotation(r0.xyz, r1.xyz, r2.xyz);
    const float3 skinned = (float3)(dot3(r0.xyz, root), dot3(r1.xyz, root), dot3(r2.xyz, root));
    result.t = skinned - quat_rotate(result.q, root) + (float3)(r0.w, r1.w, r2.w);
    pose_store(pose, strand, result);
}
