/* grid_diffuse: brake vertices that outrun their voxel.
 *
 * Items   vertices.
 * Reads   vertex_count, position, grid_density, grid_velocity.
 * Moves   position_prev, of the vertices it brakes: Verlet velocity is (position - prev) / h.
 * Source  Ugurca 2015, sections 4.3 and 4.4: a component of a vertex' velocity beyond 2 x the
 *         voxel's mean of it keeps 0.9 of itself (ratio and factor).
 * Changed PLAIT_DIFFUSE_FLOORED compares with max(|mean|, floor * rms): where the mean is near 0,
 *         in hair that swings against itself, the thesis rule brakes everything that moves at all.
 *         Components are those along the grid's axes. PLAIT_TENT_TRILINEAR interpolates between the
 *         eight voxel centres around the vertex, so nothing jumps at a voxel's face.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/grid.clh"
#include "common/strand.clh"

/* The hair around a point of the grid. */
typedef struct surroundings_t {
    float density;
    float3 mean; /* m/s, along the grid's axes */
    float mean_square;
} surroundings_t;

static inline void add_node(surroundings_t* sum, float weight, float density, float4 velocity) {
    sum->density += weight * density;
    sum->mean += weight * velocity.xyz;
    sum->mean_square += weight * (velocity.w * velocity.w);
}

static inline surroundings_t surroundings_at(const plait_grid_params* params, float3 g,
                                             __global const float* density,
                                             __global const float4* velocity) {
    surroundings_t sum = {0.0f, (float3)(0.0f), 0.0f};
    if (params->tent == PLAIT_TENT_VOXEL) {
        const uint voxel = world_to_voxel(params, g);
        add_node(&sum, 1.0f, density[voxel], velocity[voxel]);
        return sum;
    }
    const stencil_t stencil = stencil_at(params, g);
#pragma unroll
    for (uint corner = 0u; corner < 8u; ++corner) {
        const uint voxel = stencil_voxel(stencil, corner);
        add_node(&sum, stencil_weight(stencil, corner), density[voxel], velocity[voxel]);
    }
    return sum;
}

/* Per component of v: which are to be braked. */
static inline int3 outruns(const plait_grid_params* params, float3 v, surroundings_t around) {
    float3 allowed = fabs(around.mean);
    if (params->diffuse_rule == PLAIT_DIFFUSE_FLOORED)
        allowed = max(allowed, params->diffuse_floor * sqrt(around.mean_square));
    return fabs(v) > params->diffuse_ratio * allowed;
}

__kernel void plait_grid_diffuse(const uint item_count, const plait_grid_params params,
                                 __global const uint* vertex_count, __global const float4* position,
                                 __global const float* grid_density,
                                 __global const float4* grid_velocity,
                                 __global float4* position_prev) {
    const uint item = get_global_id(0);
    if (item >= item_count ||
        item % params.vertex_stride >= vertex_count[item / params.vertex_stride])
        return;
    const float4 x = position[item];
    const float3 g = grid_coordinates(&params, x.xyz);
    if (!is_free(x) || !grid_contains(&params, g))
        return;
    const surroundings_t around = surroundings_at(&params, g, grid_density, grid_velocity);
    const float4 prev = position_prev[item];
    const float3 v = grid_velocity_of(&params, x.xyz, prev.xyz);
    const int3 braked = outruns(&params, v, around);
    if (around.density > 0.0f && any(braked)) {
        const float3 kept = select(v, params.diffuse_factor * v, braked);
        const float3 step_back = quat_rotate(vload4(0, params.q), kept) * params.h;
        position_prev[item] = (float4)(x.xyz - step_back, prev.w);
    }
}
