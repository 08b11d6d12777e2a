/* air_shelter: what is left of the wind at the nodes of one plane of a grid around the groom, behind
 * the plane before it; and the air there, which otherwise goes along with the hair.
 *
 * Items   nodes of a plane.
 * Reads   air_extinction, grid_density, grid_velocity.
 * Moves   air_depth: tau, of the plane before to this one's. air_velocity: turbulence to the air's
 *         velocity in the world, and in w the share of the wind, T = e^(-tau).
 * Source  Cionco 1965 for the law; the sweep is ours.
 *
 * tau(node) = tau(foot) + (sigma(node) + sigma(foot))/2 way: `foot` is where the wind came through
 * the plane before, between four of its nodes; outside of the grid there is nothing. One look at four
 * nodes each, where a march along the wind's way takes hundreds, as exact: within .01 rms of a ball's
 * chord.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/quat.clh"
#include "plait/params.h"

/* Voxel at (a, b), along the two other axes in their order, of the plane `k` along `axis`:
 * y n^2 + z n + x. */
static inline uint voxel_at(uint n, uint axis, uint k, uint a, uint b) {
    const uint x = axis == 0u ? k : a;
    const uint y = axis == 0u ? a : axis == 1u ? k : b;
    const uint z = axis == 2u ? k : b;
    return (y * n + z) * n + x;
}

/* tau, and sigma, where the wind came from. */
static inline float2 foot_at(const plait_air_shelter_params* params, uint before, float a, float b,
                             __global const float* air_depth,
                             __global const float* air_extinction) {
    const float last = (float)(params->edge_count - 1u);
    if (!(a >= 0.0f && a <= last && b >= 0.0f && b <= last))
        return (float2)(0.0f);
    const float low_a = fmin(floor(a), fmax(last - 1.0f, 0.0f));
    const float low_b = fmin(floor(b), fmax(last - 1.0f, 0.0f));
    float2 sum = (float2)(0.0f);
#pragma unroll
    for (uint corner = 0u; corner < 4u; ++corner) {
        const float high_a = (float)(corner & 1u), high_b = (float)(corner >> 1);
        const float weight = (high_a != 0.0f ? a - low_a : 1.0f - (a - low_a)) *
                             (high_b != 0.0f ? b - low_b : 1.0f - (b - low_b));
        const uint node =
            voxel_at(params->edge_count, params->axis, before, (uint)fmin(low_a + high_a, last),
                     (uint)fmin(low_b + high_b, last));
        sum += weight * (float2)(air_depth[node], air_extinction[node]);
    }
    return sum;
}

__kernel void plait_air_shelter(const uint item_count, const plait_air_shelter_params params,
                                __global const float* air_extinction,
                                __global const float* grid_density,
                                __global const float4* grid_velocity, __global float* air_depth,
                                __global float4* air_velocity) {
    const uint item = get_global_id(0);
    const uint n = params.edge_count;
    if (item >= min(item_count, n * n))
        return;
    const uint a = item % n, b = item / n;
    const uint plane = params.reversed ? n - 1u - params.plane : params.plane;
    const uint node = voxel_at(n, params.axis, plane, a, b);
    float tau = 0.0f;
    if (params.plane > 0u) {
        const uint before = params.reversed ? plane + 1u : plane - 1u;
        const float2 foot = foot_at(&params, before, (float)a - params.foot[0],
                                    (float)b - params.foot[1], air_depth, air_extinction);
        tau = foot.x + 0.5f * (air_extinction[node] + foot.y) * params.way;
    }
    air_depth[node] = tau;
    const float open = exp(-tau);
    vec3 wind = vload3(0, params.air);
    if (params.turbulent)
        wind = add3(wind, unpack3(air_velocity[node]));
    const vec3 hair = grid_density[node] > 0.0f
                          ? rotate3(vload4(0, params.q), unpack3(grid_velocity[node]))
                          : vload3(0, params.still);
    air_velocity[node] = pack3(axpy3(open, wind, scale3(hair, 1.0f - open)), open);
}
