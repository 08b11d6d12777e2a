/* follow_field: strands that follow are turned out of meshes of form FIELD.
 *
 * Items   follows, over lanes: follow f is row guide_count + f of position.
 * Reads   lane_strand; collider (here these meshes), at the end of its substep; mesh_grid, mesh_nodes,
 *         mesh_values.
 * Moves   position of the follows; w is kept, padding is a copy of the tip.
 * Source  follows/follow_out.clh; distances as in mesh_field.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "mesh/mesh_field.clh"
#include "plait/constants.h"

typedef struct {
    mesh_field field;
    mesh_motion motion;
} follow_body;

typedef struct {
    real distance; /* m; at most the true one where that is above 0 */
    vec3 normal;   /* in the world, unit; 0: there is no telling */
} follow_distance;

LANES_INLINE follow_distance follow_gap(const follow_body* body, vec3 x, real bound, mask on) {
    const real none = (real)(0.0f);
    const vec3 own = mesh_own(&body->motion, x);
    follow_distance gap = {mesh_field_least(&body->field, own), zero3()};
    const mask near = on & (gap.distance <= none);
    if (!any_lane(near))
        return gap;
    const mesh_cell cell = mesh_cell_of(&body->field, own);
    const mesh_cells cells = mesh_cells_of(&body->field, pick_mask(near, cell.first, (mask)(0)));
    const mesh_sample sample = mesh_cell_sample(&body->field, &cell, &cells);
    const real slope = length3(sample.gradient);
    const mask some = slope > (real)(PLAIT_MESH_MIN_SLOPE);
    /* of a distance above 0 nothing is said of what is around */
    gap.distance = pick(near, pick(some, fmin(sample.distance, none), none), gap.distance);
    const vec3 normal = scale3(sample.gradient, 1.0f / pick(some, slope, (real)(1.0f)));
    gap.normal = pick3(some, mesh_turned(&body->motion, normal), zero3());
    return gap;
}

#include "follows/follow_out.clh"

__kernel PLAIT_WIDE void
plait_follow_field(const uint item_count, const plait_follow_collide_params params,
                   __global const uint* lane_strand, __global const float4* collider,
                   __global const float4* mesh_grid, __global const uint* mesh_nodes,
                   __global const float* mesh_values, __global float4* position) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    follow_rows rows;
    follow_rows_read(&rows, position, params.guide_count, lane_strand, place, item_count);
    mask moved = (mask)(0);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const follow_body body = {mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh),
                                  mesh_motion_at(collider, params.collider_first + mesh)};
        moved |= follow_leave(&body, &rows, (mask)(-1), 0);
    }
    follow_rows_write(&rows, moved, lane_place_strands(place, item_count));
}
