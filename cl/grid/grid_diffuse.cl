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
#include "base/quat.clh"
#include "base/strand.clh"
#include "grid/grid.clh"

/* The hair around a point of the grid. */
typedef struct surroundings_t {
    float density;
    vec3 mean; /* m/s, along the grid's axes */
    float mean_square;
} surroundings_t;

static inline void add_node(surroundings_t* sum, float weight, float density, float4 velocity) {
    sum->density += weight * density;
    sum->mean = axpy3(weight, unpack3(velocity), sum->mean);
    sum->mean_square += weight * (velocity.w * velocity.w);
}

static inline surroundings_t surroundings_at(const grid_frame* grid, vec3 g, uint tent,
                                             __global const float* density,
                                             __global const float4* velocity) {
    surroundings_t sum = {0.0f, zero3(), 0.0f};
    const grid_cell cell = grid_cell_of(grid, g, 1, tent);
    const uint first = (uint)grid_voxel_of(grid, cell);
    if (tent == PLAIT_TENT_VOXEL) {
        add_node(&sum, 1.0f, density[first], velocity[first]);
        return sum;
    }
    const grid_weights weights = grid_weights_of(&cell);
#pragma unroll
    for (uint corner = 0u; corner < 8u; ++corner) {
        const uint voxel = first + grid_corner(grid, corner);
        add_node(&sum, weights.of[corner], density[voxel], velocity[voxel]);
    }
    return sum;
}

/* Is a component of a velocity to be braked? */
static inline int outruns(const plait_grid_params* params, float v, float mean, float mean_square) {
    float allowed = fabs(mean);
    if (params->diffuse_rule == PLAIT_DIFFUSE_FLOORED)
        allowed = max(allowed, params->diffuse_floor * sqrt(mean_square));
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
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 g = grid_coordinates(&grid, unpack3(x));
    if (!is_free(x) || !grid_contains(&grid, g))
        return;
    const surroundings_t around =
        surroundings_at(&grid, g, params.tent, grid_density, grid_velocity);
    const float4 prev = position_prev[item];
    const vec3 v = grid_verlet_velocity(&grid, params.h, unpack3(x), unpack3(prev));
    const int on_x = outruns(&params, v.x, around.mean.x, around.mean_square),
              on_y = outruns(&params, v.y, around.mean.y, around.mean_square),
              on_z = outruns(&params, v.z, around.mean.z, around.mean_square);
    if (around.density > 0.0f && (on_x | on_y | on_z)) {
        const vec3 braked = scale3(v, params.diffuse_factor);
        const vec3 kept = vec3_of(pick(on_x, braked.x, v.x), pick(on_y, braked.y, v.y),
                                  pick(on_z, braked.z, v.z));
        const vec3 step_back = scale3(rotate3(vload4(0, params.q), kept), params.h);
        position_prev[item] = pack3(sub3(unpack3(x), step_back), prev.w);
    }
}
