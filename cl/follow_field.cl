/* follow_field: strands that follow are turned out of meshes of form FIELD.
 *
 * Items   follows: strand f here is row guide_count + f of position.
 * Reads   collider (here these meshes), at the end of its substep; mesh_grid, mesh_nodes,
 *         mesh_values.
 * Moves   position of the follows; w is kept, padding is a copy of the tip.
 * Source  common/follow_out.clh; distances as in mesh_contact.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/mesh_field.clh"
#include "plait/constants.h"

typedef struct {
    mesh_field field;
    mesh_motion motion;
} follow_body;

typedef struct {
    float distance; /* m; at most the true one where that is above 0 */
    vec3 normal;    /* in the world, unit; 0: there is no telling */
} follow_distance;

static inline follow_distance follow_gap(const follow_body* body, vec3 x, float bound) {
    const vec3 own = mesh_own(&body->motion, x);
    follow_distance gap;
    gap.normal = zero3();
    gap.distance = mesh_field_least(&body->field, own);
    if (!(gap.distance <= 0.0f))
        return gap;
    mesh_cells cells;
    cells.first = -1;
    const mesh_sample sample = mesh_field_sample(&body->field, own, &cells);
    const float slope = length3(sample.gradient);
    gap.distance = fmin(sample.distance, 0.0f); /* which says nothing of what is around */
    if (!(slope > PLAIT_MESH_MIN_SLOPE)) {
        gap.distance = 0.0f;
        return gap;
    }
    const vec3 normal = scale3(sample.gradient, 1.0f / slope);
    gap.normal = add3(normal, mesh_turn(body->motion.orientation, normal));
    return gap;
}

#include "common/follow_out.clh"

__kernel void plait_follow_field(const uint item_count, const plait_follow_collide_params params,
                                 __global const float4* collider, __global const float4* mesh_grid,
                                 __global const uint* mesh_nodes, __global const float* mesh_values,
                                 __global float4* position) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count)
        return;
    __global float4* row = follow_row(position, &params, item);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const follow_body body = {mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh),
                                  mesh_motion_at(collider, params.collider_first + mesh)};
        follow_leave(&body, row, stride);
    }
}
