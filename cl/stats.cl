/* stats: health of each strand.
 *
 * Items   strands.
 * Reads   rest_length, vertex_count, position, position_prev.
 * Writes  strand_stats: worst |l/l0 - 1| of a segment, vertices that are not finite (in position or
 *         history), longest |position - prev| in metres, mean |l/l0 - 1|. Segments with an end that
 *         is not finite, or of rest length 0, do not count.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/vec.clh"
#include "plait/params.h"

static inline bool is_finite(float3 x) {
    return all(isfinite(x));
}

/* (worst, sum, count) of stretch over the segments of a strand. */
static inline float3 stretch(uint count, __global const float* rest_length,
                             __global const float4* position) {
    float3 total = (float3)(0.0f);
    for (uint i = 0u; i + 1u < count; ++i) {
        const float3 a = position[i].xyz, b = position[i + 1u].xyz;
        if (!is_finite(a) || !is_finite(b) || !(rest_length[i] > 0.0f))
            continue;
        const float error = fabs(length3(b - a) / rest_length[i] - 1.0f);
        total = (float3)(max(total.x, error), total.y + error, total.z + 1.0f);
    }
    return total;
}

/* (vertices not finite, longest displacement) of a strand. */
float2 motion(uint count, __global const float4* position, __global const float4* position_prev) {
    float2 total = (float2)(0.0f);
    for (uint i = 0u; i < count; ++i) {
        const float3 x = position[i].xyz, prev = position_prev[i].xyz;
        if (is_finite(x) && is_finite(prev))
            total.y = max(total.y, length3(x - prev));
        else
            total.x += 1.0f;
    }
    return total;
}

__kernel void plait_stats(const uint item_count, const plait_layout_params params,
                          __global const float* rest_length, __global const uint* vertex_count,
                          __global const float4* position, __global const float4* position_prev,
                          __global float4* strand_stats) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    const size_t root = (size_t)strand * params.vertex_stride;
    const uint count = vertex_count[strand];
    const float3 s = stretch(count, rest_length + root, position + root);
    const float2 m = motion(count, position + root, position_prev + root);
    strand_stats[strand] = (float4)(s.x, m.x, m.y, s.y / max(s.z, 1.0f));
}
