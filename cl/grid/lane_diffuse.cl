/* lane_diffuse: grid_diffuse on the lanes' own velocities.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, grid_density, grid_velocity.
 * Moves   lane_v, with BDF2 lane_v_before, of the vertices it brakes; never of a root.
 * Source  as grid_diffuse.
 * Changed velocities are braked where they are kept: none is the difference of two positions; those
 *         of the step before as much, see lane_pack.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"
#include "grid/grid.clh"

/* The hair around a point of the grid. */
typedef struct {
    real density;
    vec3 mean; /* m/s, along the grid's axes */
    real mean_square;
} lane_surroundings;

/* Mean and mean square velocity (w) of a voxel and its density. */
static inline void add_voxel(float4* velocity, float* density, float weight, float4 u, float d) {
    u.w *= u.w;
    *velocity += weight * u;
    *density += weight * d;
}

static inline lane_surroundings surroundings_of(const grid_frame* grid, grid_cell cell, uint tent,
                                                __global const float* grid_density,
                                                __global const float4* grid_velocity) {
    lane_surroundings around;
    const mask low = grid_voxel_of(grid, cell);
    grid_weights weights;
    if (tent != PLAIT_TENT_VOXEL)
        weights = grid_weights_of(&cell);
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const uint first = (uint)LANE_OF_MASK(low, k);
        float4 velocity = (float4)(0.0f);
        float density = 0.0f;
        if (tent == PLAIT_TENT_VOXEL) {
            add_voxel(&velocity, &density, 1.0f, grid_velocity[first], grid_density[first]);
        } else {
#pragma unroll
            for (uint corner = 0u; corner < 8u; ++corner) {
                const uint voxel = first + grid_corner(grid, corner);
                add_voxel(&velocity, &density, LANE(weights.of[corner], k), grid_velocity[voxel],
                          grid_density[voxel]);
            }
        }
        LANE(around.density, k) = density;
        LANE(around.mean.x, k) = velocity.x;
        LANE(around.mean.y, k) = velocity.y;
        LANE(around.mean.z, k) = velocity.z;
        LANE(around.mean_square, k) = velocity.w;
    }
    return around;
}

/* What a component of a velocity loses. */
static inline real brake(const plait_lane_grid_params* params, real v, real mean, real rms,
                         mask hair) {
    real allowed = fabs(mean);
    if (params->diffuse_rule == PLAIT_DIFFUSE_FLOORED)
        allowed = fmax(allowed, params->diffuse_floor * rms);
    const mask outruns = hair & (fabs(v) > params->diffuse_ratio * allowed);
    return pick(outruns, (params->diffuse_factor - 1.0f) * v, (real)(0.0f));
}

__kernel PLAIT_WIDE void
plait_lane_diffuse(const uint item_count, const plait_lane_grid_params params,
                   __global const uint* lane_strand, __global const uint* vertex_count,
                   __global const real* lane_x, __global const float* grid_density,
                   __global const float4* grid_velocity, __global real* lane_v,
                   __global real* lane_v_before) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 root = load3(lane_x, place, 0);
    for (int i = 1; i < (int)params.vertex_stride; ++i) {
        const vec3 g = grid_coordinates(&grid, add3(root, load3(lane_x, place, i)));
        const mask inside = ((mask)(i) < counts) & grid_contains(&grid, g);
        if (!any_lane(inside))
            continue;
        const grid_cell cell = grid_cell_of(&grid, g, inside, params.tent);
        const lane_surroundings around =
            surroundings_of(&grid, cell, params.tent, grid_density, grid_velocity);
        const mask hair = inside & (around.density > (real)(0.0f));
        const real rms = sqrt(around.mean_square);
        const vec3 before = load3(lane_v, place, i);
        const vec3 v = grid_components(&grid, before);
        const vec3 lost = vec3_of(brake(&params, v.x, around.mean.x, rms, hair),
                                  brake(&params, v.y, around.mean.y, rms, hair),
                                  brake(&params, v.z, around.mean.z, rms, hair));
        const vec3 gained = grid_world(&grid, lost);
        store3(lane_v, place, i, add3(before, gained));
        if (params.history)
            store3(lane_v_before, place, i, add3(load3(lane_v_before, place, i), gained));
    }
}
