/* stats: health of each strand.
 *
 * Items   strands.
 * Reads   rest_length, vertex_count, position, position_prev.
 * Writes  strand_stats: worst |l/l0 - 1| of a segment, vertices that are not finite (in position or
 *         history), longest |position - prev| in metres, mean |l/l0 - 1|. Segments with an end that
 *         is not finite, or of rest length 0, do not count.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/vec3.clh"
#include "plait/params.h"

static inline bool is_finite(vec3 x) {
    return isfinite(x.x) && isfinite(x.y) && isfinite(x.z);
}

/* |l/l0 - 1| over the segments of a strand. */
typedef struct {
    float worst, sum, count;
} stretch_t;

static inline stretch_t stretch(uint count, __global const float* rest_length,
                                __global const float4* position) {
    stretch_t total = {0.0f, 0.0f, 0.0f};
    for (uint i = 0u; i + 1u < count; ++i) {
        const vec3 a = unpack3(position[i]), b = unpack3(position[i + 1u]);
        if (!is_finite(a) || !is_finite(b) || !(rest_length[i] > 0.0f))
            continue;
        const float error = fabs(length3(sub3(b, a)) / rest_length[i] - 1.0f);
        total.worst = max(total.worst, error);
        total.sum += error;
        total.count += 1.0f;
    }
    return total;
}

/* (vertices not finite, longest displacement) of a strand. */
float2 motion(uint count, __global const float4* position, __global const float4* position_prev) {
    float2 total = (float2)(0.0f);
    for (uint i = 0u; i < count; ++i) {
        const vec3 x = unpack3(position[i]), prev = unpack3(position_prev[i]);
        if (is_finite(x) && is_finite(prev))
            total.y = max(total.y, length3(sub3(x, prev)));
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
    const stretch_t s = stretch(count, rest_length + root, position + root);
    const float2 m = motion(count, position + root, position_prev + root);
    strand_stats[strand] = (float4)(s.worst, m.x, m.y, s.sum / max(s.count, 1.0f));
}
