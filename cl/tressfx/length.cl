/* length: red/black edge-length constraint.
 *
 * Items   strands, V work-items of one work-group each.
 * Reads   rest_length, vertex_count.
 * Moves   position.
 * Source  Han & Harada 2012, section 3; TressFX 4.1. Edge d = x_(i+1) - x_i: both ends take half of
 *         (1 - l / max(|d|, 1e-7)) d, or a free one all of it beside a pinned one. Even edges
 *         first, then odd ones: edges of a colour share no vertex.
 * Changed any V, by padded strides in work-group memory, and any count per strand; every work-item
 *         reaches every barrier. An edge of no length stays so rather than turning into NaN.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/strand.clh"
#include "base/vec3.clh"
#include "plait/constants.h"
#include "plait/params.h"

static inline void satisfy_edge(float rest_length, __local float4* a, __local float4* b) {
    const float4 xa = *a, xb = *b;
    const vec3 a_at = unpack3(xa), b_at = unpack3(xb), d = sub3(b_at, a_at);
    const float stretch = 1.0f - rest_length / max(length3(d), PLAIT_LENGTH_MIN_DISTANCE);
    const float share = is_free(xa) && is_free(xb) ? 0.5f : 1.0f;
    const vec3 excess = scale3(scale3(d, stretch), share);
    if (is_free(xa))
        *a = pack3(add3(a_at, excess), xa.w);
    if (is_free(xb))
        *b = pack3(sub3(b_at, excess), xb.w);
}

__kernel void plait_length(const uint item_count, const plait_length_params params,
                           __global const float* rest_length, __global const uint* vertex_count,
                           __global float4* position, __local float4* shared_position) {
    const strand_item_t item = strand_item(params.vertex_stride);
    const uint count = item.strand < item_count ? vertex_count[item.strand] : 0u;
    const bool has_edge = item.vertex + 1u < count;
    const float edge_length = has_edge ? rest_length[item.element] : 0.0f;
    __local float4* shared = shared_position + item.local_index;
    if (item.vertex < count)
        *shared = position[item.element];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint pass = 0u; pass < 2u * params.iterations; ++pass) {
        if (has_edge && item.vertex % 2u == pass % 2u)
            satisfy_edge(edge_length, shared, shared + item.local_next);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (item.vertex < count)
        position[item.element] = *shared;
}
