/* follow_curl: curl and frizz of follow strands, as offsets in a frame that the strand carries along.
 *
 * Items   follows: strand f here is row guide_count + f of position.
 * Reads   pose of the guides; follow_guide, clump_centre, follow_way, follow_arc; position.
 * Writes  position of the follows; w and the root are kept, padding is a copy of the tip.
 * Source  x_i + r(s) (u cos + v sin)(2 pi (s/pitch + phase)) + f(s) (u N_0(s) + v N_1(s)), s the arc
 *         length at rest, u and v normal to the strand, carried along it without twist (Bergou et al.
 *         2008), N gradient noise in one dimension (Perlin 2002), its rms 1.
 * Changed nothing here depends on time or on where hair is: phases and noise are those of strand and
 *         arc length. u at the root at rest is x turned by the shortest rotation that takes +y to the
 *         strand's direction, so neighbours have nearly the same, but where hair points straight down.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/hash.clh"
#include "base/pose.clh"
#include "base/ramp.clh"
#include "plait/constants.h"

/* Gradient noise of a strand whose hash is `strand`, two components. */
static inline float2 noise_at(float at, uint strand) {
    const float low = floor(at), t = at - low;
    const uint cell = (uint)(int)low;
    const uint before = pcg(cell ^ strand), after = pcg((cell + 1u) ^ strand);
    const float2 a = (float2)(hash_share(before), hash_share(pcg(before))) * 2.0f - 1.0f;
    const float2 b = (float2)(hash_share(after), hash_share(pcg(after))) * 2.0f - 1.0f;
    const float fade = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    return ((1.0f - fade) * t * a + fade * (t - 1.0f) * b) / PLAIT_FRIZZ_NOISE_RMS;
}

/* Along u and v at `arc` m from the root. */
static inline float2 offset_at(const plait_follow_curl_params* params, float arc, float share,
                               float phase, uint strand) {
    const float curl = ramp_at(params->curl, share), frizz = ramp_at(params->frizz, share);
    float2 offset = (float2)(0.0f);
    if (curl > 0.0f) {
        const float turns = arc / params->pitch + phase;
        const float angle = 2.0f * (turns - floor(turns));
        offset = curl * (float2)(cospi(angle), sinpi(angle));
    }
    if (frizz > 0.0f)
        offset += frizz * noise_at(arc / params->frizz_length + hash_share(pcg(strand)), strand);
    return offset;
}

__kernel void plait_follow_curl(const uint item_count, const plait_follow_curl_params params,
                                __global const float4* pose, __global const uint* follow_guide,
                                __global const uint* clump_centre,
                                __global const float4* follow_way, __global const float* follow_arc,
                                __global float4* position) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count)
        return;
    const size_t from = (size_t)item * stride, to = from + (size_t)params.guide_count * stride;
    const float length = follow_arc[from + stride - 1];
    const uint clump = pcg(clump_centre[item] ^ pcg(params.seed));
    const uint strand = pcg((params.guide_count + item) ^ pcg(~params.seed));
    const float phase = hash_share(clump) + params.scatter * hash_share(strand);
    const quat q = pose_load(pose, follow_guide[item]).q;
    const vec3 rest = unpack3(follow_way[item]);
    const vec3 across = turn_between(vec3_of(0.0f, 1.0f, 0.0f), rest, vec3_of(1.0f, 0.0f, 0.0f));
    vec3 along = rotate3(q, rest), u = rotate3(q, across);
    vec3 x = unpack3(position[to]), shown = x;
    for (uint i = 1; i < stride; ++i) {
        const float arc = follow_arc[from + i];
        const float4 now = position[to + i];
        if (arc > follow_arc[from + i - 1]) {
            const vec3 x_now = unpack3(now), next = normalize3(sub3(x_now, x));
            u = turn_between(along, next, u);
            along = dot3(next, next) > 0.0f ? next : along;
            const float2 offset = offset_at(&params, arc, arc / length, phase, strand);
            shown = axpy3(offset.y, cross3(along, u), axpy3(offset.x, u, x_now));
            x = x_now;
        }
        position[to + i] = pack3(shown, now.w);
    }
}
