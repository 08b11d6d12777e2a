/* follow_clump: follow strands drawn to the centres of their clumps, by turns of their segments.
 *
 * Items   follows: strand f here is row guide_count + f of position.
 * Reads   clump_centre, clump_place, strand_wetness, follow_arc; position of the strand and of its centre, which no
 *         item writes.
 * Writes  position of the follows but for centres; w is kept, padding is a copy of the tip.
 * Source  clumping as groomers know it, x_i + c(s_i) (X(s_i) - x_i), c a ramp and X the centre at the
 *         same share of length, is where a strand shall go: the path p. A strand that went there
 *         would be shorter or longer than it is.
 *         Where hair is wet c is times PLAIT_WET_FOLLOW and the wetness of the centre, which is then
 *         the strand's guide.
 * Changed each segment keeps its length and points along that path, and towards it where the strand
 *         is beside it: y_i = y_(i-1) + |x_i - x_(i-1)| n(a + g/max(reach, |g|)), a the direction of
 *         the path's segment, g what leads to that from y_(i-1), normal to a. So no segment is more
 *         than 45 degrees off the path's, and one that ends later than its centre goes on beside it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/ramp.clh"
#include "common/vec.clh"
#include "plait/constants.h"
#include "plait/params.h"

/* The strand whose row begins at `row`, between two of its vertices. */
static inline float3 place_on(__global const float4* position, size_t row, uint stride,
                              float place) {
    const float held = clamp(place, 0.0f, (float)(stride - 1));
    const uint a = min((uint)held, stride - 2u);
    const float t = held - (float)a;
    return (1.0f - t) * position[row + a].xyz + t * position[row + a + 1].xyz;
}

/* Unit, for a segment `segment` of a strand that is `gap` away from where the path's segment `path`
 * begins. */
static inline float3 direction_along(float3 segment, float3 path, float3 gap, float length) {
    const float3 along = normalize_or_zero(dot3(path, path) > 0.0f ? path : segment);
    const float3 aside = gap - dot3(along, gap) * along;
    const float reach = PLAIT_CLUMP_REACH * length + PLAIT_CLUMP_REACH_SEGMENTS * length3(segment);
    return normalize_or_zero(along + aside / fmax(fmax(reach, length3(aside)), FLT_MIN));
}

__kernel void plait_follow_clump(const uint item_count, const plait_follow_clump_params params,
                                 __global const uint* clump_centre,
                                 __global const float* clump_place,
                                 __global const float* strand_wetness,
                                 __global const float* follow_arc, __global float4* position) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count || clump_centre[item] == params.guide_count + item)
        return;
    const size_t from = (size_t)item * stride, to = from + (size_t)params.guide_count * stride;
    const size_t centre = (size_t)clump_centre[item] * stride;
    const float share = params.wet ? PLAIT_WET_FOLLOW * strand_wetness[clump_centre[item]] : 1.0f;
    if (share == 0.0f)
        return;
    const float length = follow_arc[from + stride - 1];
    const float3 root = position[to].xyz;
    float3 x = (float3)(0.0f), way = (float3)(0.0f); /* all from the root */
    float3 path = share * ramp_at(params.clump, 0.0f) *
                  (place_on(position, centre, stride, clump_place[from]) - root);
    for (uint i = 1; i < stride; ++i) {
        const float arc = follow_arc[from + i];
        const float4 now = position[to + i];
        if (arc > follow_arc[from + i - 1]) {
            const float3 x_now = now.xyz - root;
            const float3 aim = place_on(position, centre, stride, clump_place[from + i]) - root;
            const float drawn = share * ramp_at(params.clump, arc / length);
            const float3 path_now = x_now + drawn * (aim - x_now);
            const float3 segment = x_now - x;
            way += length3(segment) * direction_along(segment, path_now - path, path - way, length);
            x = x_now;
            path = path_now;
        }
        position[to + i] = (float4)(root + way, now.w);
    }
}
