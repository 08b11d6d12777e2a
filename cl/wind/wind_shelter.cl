/* wind_shelter: what is left of the wind at the nodes of a grid around the groom, plane by plane, behind
 * the plane before; and the air there, which otherwise goes along with the hair.
 *
 * Items   one, the grid; a work-item of its group takes as many nodes of each plane at a time as it has lanes.
 * Reads   wind_extinction, grid_density, grid_velocity.
 * Moves   wind_depth: tau, of the plane before to this one's. wind_velocity: turbulence to the air's
 *         velocity in the world, and in w the share of the wind, T = e^(-tau).
 * Source  Cionco 1965 for the law; the sweep is ours.
 *
 * tau(node) = tau(foot) + (sigma(node) + sigma(foot))/2 way: `foot` is where the wind came through
 * the plane before, between four of its nodes; outside of the grid there is nothing. One look at four
 * nodes each, where a march along the wind's way takes hundreds, as exact: within .01 rms of a ball's
 * chord.
 */
#pragma OPENCL FP_CONTRACT OFF
#define PLAIT_LANES PLAIT_DEVICE_LANES
#include "base/lane_rows.clh"
#include "plait/params.h"

/* From a node to the next: from plane to plane, and along the two other axes in their order. */
typedef struct {
    int plane, a, b;
} node_steps;

/* Voxels are y n^2 + z n + x. */
static inline node_steps node_steps_of(uint n, uint axis) {
    const int x = 1, y = (int)(n * n), z = (int)n;
    const node_steps steps = {axis == 0u   ? x
                              : axis == 1u ? y
                                           : z,
                              axis == 0u ? y : x, axis == 2u ? y : z};
    return steps;
}

/* tau, and sigma, where the wind came from. */
typedef struct {
    real depth, extinction;
} shelter_foot;

static inline shelter_foot foot_at(uint n, node_steps steps, uint before, real a, real b,
                                   __global const float* wind_depth,
                                   __global const float* wind_extinction) {
    const real zero = (real)(0.0f), one = (real)(1.0f), last = (real)((float)(n - 1u));
    const mask inside = (a >= zero) & (a <= last) & (b >= zero) & (b <= last);
    const mask most = (mask)(max((int)n - 2, 0));
    const mask low_a = min(LANE_INT(pick(inside, a, zero)), most);
    const mask low_b = min(LANE_INT(pick(inside, b, zero)), most);
    const real high_a = a - LANE_REAL(low_a), high_b = b - LANE_REAL(low_b);
    const mask first = (int)before * steps.plane + low_a * steps.a + low_b * steps.b;
    const int next = n > 1u ? 1 : 0;
    shelter_foot foot = {zero, zero};
#pragma unroll
    for (int corner = 0; corner < 4; ++corner) {
        const int way = next * ((corner & 1) * steps.a + (corner >> 1) * steps.b);
        real depth, extinction;
        for (uint k = 0; k < PLAIT_LANES; ++k) {
            const int node = LANE_OF_MASK(first, k) + way;
            LANE(depth, k) = wind_depth[node];
            LANE(extinction, k) = wind_extinction[node];
        }
        const real weight =
            (corner & 1 ? high_a : one - high_a) * (corner & 2 ? high_b : one - high_b);
        foot.depth += weight * depth;
        foot.extinction += weight * extinction;
    }
    foot.depth = pick(inside, foot.depth, zero);
    foot.extinction = pick(inside, foot.extinction, zero);
    return foot;
}

static inline real node_number(__global const float* data, mask node) {
    real number;
    for (uint k = 0; k < PLAIT_LANES; ++k)
        LANE(number, k) = data[LANE_OF_MASK(node, k)];
    return number;
}

/* Of nodes `item` and after it, of plane `number` as the wind meets them. */
static inline void shelter_nodes(const plait_wind_shelter_params* params, uint number, uint item,
                                 __global const float* wind_extinction,
                                 __global const float* grid_density,
                                 __global const float4* grid_velocity, __global float* wind_depth,
                                 __global float4* wind_velocity) {
    const uint n = params->edge_count, nodes = n * n;
    const node_steps steps = node_steps_of(n, params->axis);
    const uint plane = params->reversed ? n - 1u - number : number;
    mask a, b;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const uint of = min(item + k, nodes - 1u);
        LANE_OF_MASK(a, k) = (int)(of % n);
        LANE_OF_MASK(b, k) = (int)(of / n);
    }
    const mask node = (int)plane * steps.plane + a * steps.a + b * steps.b;
    real tau = (real)(0.0f);
    if (number > 0u) {
        const uint before = params->reversed ? plane + 1u : plane - 1u;
        const shelter_foot foot =
            foot_at(n, steps, before, LANE_REAL(a) - params->foot[0],
                    LANE_REAL(b) - params->foot[1], wind_depth, wind_extinction);
        tau = foot.depth +
              0.5f * (node_number(wind_extinction, node) + foot.extinction) * params->way;
    }
    const real open = exp(-tau);
    vec3 wind = vec3_of((real)(params->air[0]), (real)(params->air[1]), (real)(params->air[2]));
    if (params->turbulent)
        wind = add3(wind, vector_part(lane_gather(wind_velocity, node)));
    const quat turn = quat_of((real)(params->q[0]), (real)(params->q[1]), (real)(params->q[2]),
                              (real)(params->q[3]));
    const vec3 still =
        vec3_of((real)(params->still[0]), (real)(params->still[1]), (real)(params->still[2]));
    const vec3 hair = pick3(node_number(grid_density, node) > (real)(0.0f),
                            rotate3(turn, vector_part(lane_gather(grid_velocity, node))), still);
    const vec3 air = axpy3(open, wind, scale3(hair, (real)(1.0f) - open));
    for (uint k = 0; k < min((uint)PLAIT_LANES, nodes - item); ++k) {
        const int at = LANE_OF_MASK(node, k);
        wind_depth[at] = LANE(tau, k);
        wind_velocity[at] = (float4)(LANE(air.x, k), LANE(air.y, k), LANE(air.z, k), LANE(open, k));
    }
}

/* The planes wait for each other in one work-group, and not in a launch each. */
__kernel PLAIT_WIDE void
plait_wind_shelter(const uint item_count, const plait_wind_shelter_params params,
                   __global const float* wind_extinction, __global const float* grid_density,
                   __global const float4* grid_velocity, __global float* wind_depth,
                   __global float4* wind_velocity) {
    const uint n = params.edge_count;
    const uint nodes = get_group_id(0) < item_count ? n * n : 0u;
    const uint first = get_local_id(0) * PLAIT_LANES, step = get_local_size(0) * PLAIT_LANES;
    for (uint number = params.plane; number < n; ++number) {
        for (uint item = first; item < nodes; item += step)
            shelter_nodes(&params, number, item, wind_extinction, grid_density, grid_velocity,
                          wind_depth, wind_velocity);
        barrier(CLK_GLOBAL_MEM_FENCE);
    }
}
