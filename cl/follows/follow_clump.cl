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
#include "base/ramp.clh"
#include "base/vec3.clh"
#include "plait/constants.h"
#include "plait/params.h"

/* The strand whose row begins at `row`, between two of its vertices. */
static inline vec3 place_on(__global const float4* position, size_t row, uint stride, float place) {
    const float held = clamp(place, 0.0f, (float)(stride - 1));
    const uint a = min((uint)held, stride - 2u);
    const float t = held - (float)a;
    const vec3 begin = unpack3(position[row + a]), end = unpack3(position[row + a + 1]);
    return axpy3(t, end, scale3(begin, 1.0f - t));
}

/* Unit, for a segment `segment` of a strand that is `gap` away from where the path's segment `path`
 * begins. */
static inline vec3 direction_along(vec3 segment, vec3 path, vec3 gap, float length) {
    const vec3 along = normalize3(dot3(path, path) > 0.0f ? path : segment);
    const vec3 aside = axpy3(-dot3(along, gap), along, gap);
    const float reach = PLAIT_CLUMP_REACH * length + PLAIT_CLUMP_REACH_SEGMENTS * length3(segment);
    return normalize3(add3(along, div3(aside, fmax(fmax(reach, length3(aside)), FLT_MIN))));
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
    const vec3 root = unpack3(position[to]);
    vec3 x = zero3(), way = x; /* all from the root */
    const vec3 aim_root = sub3(place_on(position, centre, stride, clump_place[from]), root);
    vec3 path = scale3(aim_root, share * ramp_at(params.clump, 0.0f));
    for (uint i = 1; i < stride; ++i) {
        const float arc = follow_arc[from + i];
        const float4 now = position[to + i];
        if (arc > follow_arc[from + i - 1]) {
            const vec3 x_now = sub3(unpack3(now), root);
            const vec3 aim = sub3(place_on(position, centre, stride, clump_place[from + i]), root);
            const float drawn = share * ramp_at(params.clump, arc / length);
            const vec3 path_now = axpy3(drawn, sub3(aim, x_now), x_now);
            const vec3 segment = sub3(x_now, x);
            const vec3 along =
                direction_along(segment, sub3(path_now, path), sub3(path, way), length);
            way = axpy3(length3(segment), along, way);
            x = x_now;
            path = path_now;
        }
        position[to + i] = pack3(add3(root, way), now.w);
    }
}
