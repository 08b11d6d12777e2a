/* wind_field: turbulence of the wind at the nodes of a grid, the centres of its voxels.
 *
 * Items   voxels; a work-item takes as many as it has lanes, and those past the last have none.
 * Reads   nothing but its parameters.
 * Writes  wind_velocity, m/s, components in the world; w 1, all of it.
 * Source  Bridson, Hourihan & Nordenstam 2007: the curl of three potentials of gradient noise
 *         (Perlin 2002, derivatives in closed form), which no point is a source of.
 * Changed lattice points have hashes, not tables of them, so that the wind never repeats.
 */
#pragma OPENCL FP_CONTRACT OFF
#define PLAIT_LANES PLAIT_DEVICE_LANES
#include "base/quat.clh"
#include "plait/params.h"

#if PLAIT_LANES == 1
typedef uint hash;
#define HASH_OF(value) as_uint(value)
#define INT_OF(value) as_int(value)
#else
typedef PLAIT_JOIN(uint, PLAIT_LANES) hash;
#define HASH_OF(value) PLAIT_JOIN(as_uint, PLAIT_LANES)(value)
#define INT_OF(value) PLAIT_JOIN(as_int, PLAIT_LANES)(value)
#endif

/* pcg of base/hash.clh. */
static inline hash pcg_of(hash x) {
    const hash state = x * 747796405u + 2891336453u;
    const hash word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/* Components of a gradient, [-1, 1), from successive hashes. */
static inline real noise_component(hash h) {
    return LANE_REAL(INT_OF(h >> 8)) * 0x1p-23f - 1.0f;
}
static inline vec3 noise_vector(hash h) {
    const hash x = pcg_of(h), y = pcg_of(x), z = pcg_of(y);
    return vec3_of(noise_component(x), noise_component(y), noise_component(z));
}

/* Along an axis a place in the noise's lattice: its cell, its place there, and of both ends of the cell
 * the weight and its derivative. */
typedef struct {
    hash cell;
    real at;
    real weight[2], slope[2];
} noise_axis;

static inline noise_axis noise_axis_of(uint corner, real offset) {
    const real low = floor(offset);
    noise_axis axis;
    axis.cell = corner + HASH_OF(LANE_INT(low));
    const real t = axis.at = offset - low;
    axis.weight[1] = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    axis.slope[1] = 30.0f * t * t * (t * (t - 2.0f) + 1.0f);
    axis.weight[0] = 1.0f - axis.weight[1];
    axis.slope[0] = -axis.slope[1];
    return axis;
}

typedef struct {
    noise_axis x, y, z;
} noise_place;

/* Derivatives of one potential along the axes. */
static inline vec3 noise_derivatives(const noise_place* place, hash seed) {
    const hash root = pcg_of(seed);
    const real zero = (real)(0.0f);
    vec3 sum = vec3_of(zero, zero, zero);
#pragma unroll
    for (uint k = 0; k < 2; ++k) {
        const hash of_z = pcg_of((place->z.cell + k) ^ root);
#pragma unroll
        for (uint j = 0; j < 2; ++j) {
            const hash of_y = pcg_of((place->y.cell + j) ^ of_z);
#pragma unroll
            for (uint i = 0; i < 2; ++i) {
                const vec3 g = noise_vector(pcg_of((place->x.cell + i) ^ of_y));
                const real value = g.x * (place->x.at - (float)i) + g.y * (place->y.at - (float)j) +
                                   g.z * (place->z.at - (float)k);
                const real x = place->x.weight[i], y = place->y.weight[j], z = place->z.weight[k];
                sum = axpy3(x * y * z, g, sum);
                sum = axpy3(value,
                            vec3_of(place->x.slope[i] * y * z, x * place->y.slope[j] * z,
                                    x * y * place->z.slope[k]),
                            sum);
            }
        }
    }
    return sum;
}

/* Curl of the three potentials of an octave. */
static inline vec3 noise_curl(const noise_place* place, uint seed) {
    vec3 d[3];
#pragma unroll
    for (uint potential = 0; potential < 3; ++potential)
        d[potential] = noise_derivatives(place, pcg_of((hash)(seed ^ potential * 0x9e3779b9u)));
    return vec3_of(d[2].y - d[1].z, d[0].z - d[2].x, d[1].x - d[0].y);
}

static inline vec3 turbulence_at(const plait_wind_field_params* params, vec3 from_corner) {
    const real zero = (real)(0.0f);
    vec3 sum = vec3_of(zero, zero, zero);
    float amplitude = params->amplitude, frequency = 1.0f;
    for (uint octave = 0; octave < params->octaves; ++octave) {
        const noise_place at = {noise_axis_of(params->cell[0] << octave,
                                              (params->fraction[0] + from_corner.x) * frequency),
                                noise_axis_of(params->cell[1] << octave,
                                              (params->fraction[1] + from_corner.y) * frequency),
                                noise_axis_of(params->cell[2] << octave,
                                              (params->fraction[2] + from_corner.z) * frequency)};
        sum = axpy3((real)(amplitude), noise_curl(&at, params->seed + octave), sum);
        amplitude *= params->gain;
        frequency *= 2.0f;
    }
    return sum;
}

__kernel PLAIT_WIDE void plait_wind_field(const uint item_count,
                                          const plait_wind_field_params params,
                                          __global float4* wind_velocity) {
    const uint first = get_global_id(0) * PLAIT_LANES, n = params.edge_count;
    if (first >= item_count)
        return;
    vec3 cell;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const uint item = first + k;
        LANE(cell.x, k) = (float)(item % n);
        LANE(cell.y, k) = (float)(item / (n * n));
        LANE(cell.z, k) = (float)(item / n % n);
    }
    const real half_voxel = (real)(0.5f);
    const vec3 along =
        scale3(add3(cell, vec3_of(half_voxel, half_voxel, half_voxel)), (real)(params.voxel_edge));
    const quat turn =
        quat_of((real)(params.q[0]), (real)(params.q[1]), (real)(params.q[2]), (real)(params.q[3]));
    const vec3 u = turbulence_at(&params, rotate3(turn, along));
    for (uint k = 0; k < min((uint)PLAIT_LANES, item_count - first); ++k)
        wind_velocity[first + k] = (float4)(LANE(u.x, k), LANE(u.y, k), LANE(u.z, k), 1.0f);
}
