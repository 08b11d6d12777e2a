/* air_field: turbulence of the wind at the nodes of a grid, the centres of its voxels.
 *
 * Items   voxels.
 * Reads   nothing but its parameters.
 * Writes  air_velocity, m/s, components in the world; w 1, all of it.
 * Source  Bridson, Hourihan & Nordenstam 2007: the curl of three potentials of gradient noise
 *         (Perlin 2002, derivatives in closed form), which no point is a source of.
 * Changed lattice points have hashes, not tables of them, so that the wind never repeats.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"

/* Components of a gradient, [-1, 1), from successive hashes. */
static inline float noise_component(uint hash) {
    return (float)(hash >> 8) * 0x1p-23f - 1.0f;
}
static inline float3 noise_vector(uint hash) {
    const uint x = pcg(hash), y = pcg(x), z = pcg(y);
    return (float3)(noise_component(x), noise_component(y), noise_component(z));
}

/* A place in the noise's lattice: its cell, its place there, and what of a value fades in towards the
 * next cell, with its derivative. */
typedef struct {
    uint3 cell;
    float3 at, fade, slope;
} noise_place;

static inline noise_place noise_place_of(uint3 corner, float3 offset) {
    const float3 low = floor(offset);
    noise_place place;
    place.cell = corner + as_uint3(convert_int3(low));
    const float3 t = place.at = offset - low;
    place.fade = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    place.slope = 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
    return place;
}

/* Derivatives of one potential along the axes. */
static inline float3 noise_derivatives(const noise_place* place, uint seed) {
    const uint root = pcg(seed);
    float3 sum = (float3)(0.0f);
#pragma unroll
    for (uint corner = 0; corner < 8; ++corner) {
        const uint3 step = (uint3)(corner & 1u, corner >> 1 & 1u, corner >> 2);
        const uint3 cell = place->cell + step;
        const float3 high = convert_float3(step);
        const float3 g = noise_vector(pcg(cell.x ^ pcg(cell.y ^ pcg(cell.z ^ root))));
        const float3 from = place->at - high;
        const float value = g.x * from.x + g.y * from.y + g.z * from.z;
        const float3 w = 1.0f - high + (2.0f * high - 1.0f) * place->fade;
        const float3 dw = (2.0f * high - 1.0f) * place->slope;
        sum += g * (w.x * w.y * w.z) +
               value * (float3)(dw.x * w.y * w.z, w.x * dw.y * w.z, w.x * w.y * dw.z);
    }
    return sum;
}

/* Curl of the three potentials of an octave. */
static inline float3 noise_curl(const noise_place* place, uint seed) {
    const float3 a = noise_derivatives(place, pcg(seed));
    const float3 b = noise_derivatives(place, pcg(seed ^ 0x9e3779b9u));
    const float3 c = noise_derivatives(place, pcg(seed ^ 2u * 0x9e3779b9u));
    return (float3)(c.y - b.z, a.z - c.x, b.x - a.y);
}

static inline float3 turbulence_at(const plait_air_field_params* params, float3 from_corner) {
    const float3 place =
        (float3)(params->fraction[0], params->fraction[1], params->fraction[2]) + from_corner;
    const uint3 cell = (uint3)(params->cell[0], params->cell[1], params->cell[2]);
    float3 sum = (float3)(0.0f);
    float amplitude = params->amplitude, frequency = 1.0f;
    for (uint octave = 0; octave < params->octaves; ++octave) {
        const noise_place at = noise_place_of(cell << octave, place * frequency);
        sum += amplitude * noise_curl(&at, params->seed + octave);
        amplitude *= params->gain;
        frequency *= 2.0f;
    }
    return sum;
}

__kernel void plait_air_field(const uint item_count, const plait_air_field_params params,
                              __global float4* air_velocity) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint n = params.edge_count;
    const float3 cell = (float3)((float)(item % n), (float)(item / (n * n)), (float)(item / n % n));
    const float3 along = (cell + 0.5f) * params.voxel_edge;
    const float3 from_corner = quat_rotate(vload4(0, params.q), along);
    air_velocity[item] = (float4)(turbulence_at(&params, from_corner), 1.0f);
}
