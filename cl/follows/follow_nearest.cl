/* follow_nearest: strands that follow are turned out of meshes of form NEAREST.
 *
 * Items   follows, over lanes: follow f is row guide_count + f of position.
 * Reads   lane_strand; collider (here these meshes) and mesh_..., as mesh_nearest, at the end of the substep.
 * Moves   position of the follows; w is kept, padding is a copy of the tip.
 * Source  follows/follow_out.clh; distances as in mesh_nearest.
 * Limit   not of sheets, which have no inside.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "mesh/lane_nearest.clh"

typedef struct {
    near_mesh mesh;
    mesh_motion motion;
    float share; /* of the fixed step, at which vertices are looked at */
} follow_body;

typedef struct {
    real distance; /* m */
    vec3 normal;   /* in the world, unit; 0: there is no telling */
} follow_distance;

/* What is not within `bound` of the surface is outside. */
static inline follow_distance follow_gap(const follow_body* body, vec3 x, real bound, mask on) {
    const vec3 own = mesh_own(&body->motion, x);
    const near_found found = near_search(&body->mesh, body->share, own, bound, on);
    follow_distance gap = {bound, zero3()};
    const mask some = found.triangle >= 0;
    if (!any_lane(some))
        return gap;
    const near_sample sample = near_sample_of(&body->mesh, found, body->share, own);
    gap.distance = pick(some, sample.distance, bound);
    gap.normal = mesh_turned(&body->motion, sample.normal);
    return gap;
}

#include "follows/follow_out.clh"

__kernel PLAIT_WIDE void
plait_follow_nearest(const uint item_count, const plait_follow_collide_params params,
                     __global const uint* lane_strand, __global const float4* collider,
                     __global const uint* mesh_first, __global const float4* mesh_box,
                     __global const uint* mesh_tree, __global const uint* mesh_triangle,
                     __global const uint* mesh_ring, __global const float4* mesh_from,
                     __global const float4* mesh_to, __global const float* mesh_bends,
                     __global float4* position) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    follow_rows rows;
    follow_rows_read(&rows, position, params.guide_count, lane_strand, place, item_count);
    mask moved = (mask)(0);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const uint index = params.collider_first + mesh;
        follow_body body;
        body.mesh = near_mesh_at(mesh_first, mesh_box, mesh_tree, mesh_triangle, mesh_ring,
                                 mesh_from, mesh_to, mesh_bends, mesh);
        body.motion = mesh_motion_at(collider, index);
        body.share = collider[PLAIT_COLLIDER_STRIDE * (size_t)index + PLAIT_COLLIDER_END].w;
        if (!body.mesh.two_sided)
            moved |= follow_leave(&body, &rows, (mask)(-1), 0);
    }
    follow_rows_write(&rows, moved, lane_place_strands(place, item_count));
}
