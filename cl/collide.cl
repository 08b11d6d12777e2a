/* collide: push free vertices out of colliders, with Coulomb friction.
 *
 * Items   vertices.
 * Reads   vertex_count, collider (both ends of its step), position_prev.
 * Moves   position.
 * Source  TressFX 4.1 (cone between two spheres); friction as in position-based dynamics, Macklin
 * et al. 2014, section 6.1, on the displacement of the step. Changed the normal is that of the hull
 * of the two spheres, so cone and ends meet without a crease; the capsule moves within the step,
 * and friction acts relative to its surface, which turns with it. Friction is bounded by
 * coefficient * push and never reverses the slip. Limit   a vertex is tested where it is, not along
 * its way: see docs/stages/collide.md. */
#pragma OPENCL FP_CONTRACT OFF
#undef PLAIT_LANES
#define PLAIT_LANES 1 /* the colliders that strand models know, for a vertex alone */
#include "common/lane_collider.clh"
#include "common/strand.clh"

/* Where a point of the collider at the substep's end was at its begin. */
static inline vec3 carry_back(__global const float4* row, vec3 x) {
    const float4 from = row[PLAIT_COLLIDER_BEGIN], to = row[PLAIT_COLLIDER_END];
    const float4 turn = row[PLAIT_COLLIDER_TURN];
    const vec3 arm = vec3_of(x.x - to.x, x.y - to.y, x.z - to.z);
    const quat back = quat_of(-turn.x, -turn.y, -turn.z, turn.w);
    return add3(vec3_of(from.x, from.y, from.z), rotate3(back, arm));
}

/* Coulomb friction on positions: takes from `slip`, the displacement relative to the surface, its
 * tangential part, but never more than friction * depth and so never reversing it. Returns what to
 * add to the position. `depth` is the push along the normal, > 0. */
static inline vec3 coulomb(vec3 slip, vec3 normal, float depth, float friction) {
    const vec3 tangential = axpy3(-dot3(slip, normal), normal, slip);
    const float amount = sqrt(dot3(tangential, tangential));
    const float limit = friction * depth;
    return scale3(tangential, amount <= limit ? -1.0f : -limit / amount);
}

static inline vec3 collide_with(__global const float4* colliders, uint index, vec3 x, vec3 prev) {
    const float3 point = (float3)(x.x, x.y, x.z);
    if (!lane_collider_meets(colliders + PLAIT_COLLIDER_STRIDE * (size_t)index, point, point, 0.0f))
        return x; /* most vertices, without a division */
    const float kind = lane_collider_kind(colliders, index);
    const vec3 origin = vec3_of(0.0f, 0.0f, 0.0f);
    lane_collider collider = lane_collider_at(kind, colliders, index);
    lane_collider_ready(kind, &collider);
    const lane_gap gap = lane_collider_gap(kind, &collider, origin, x);
    if (!(gap.distance < 0.0f))
        return x;
    const vec3 pushed = axpy3(-gap.distance, gap.normal, x);
    const vec3 slip = sub3(carry_back(collider.row, pushed), prev);
    const float friction = lane_collider_friction(colliders, index);
    return add3(pushed, coulomb(slip, gap.normal, -gap.distance, friction));
}

__kernel void plait_collide(const uint item_count, const plait_collide_params params,
                            __global const uint* vertex_count, __global const float4* collider,
                            __global const float4* position_prev, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 before = position[item];
    const uint strand = item / params.vertex_stride;
    if (item % params.vertex_stride >= vertex_count[strand] || !is_free(before))
        return;
    const float4 prev = position_prev[item];
    vec3 x = vec3_of(before.x, before.y, before.z);
    for (uint index = 0u; index < params.collider_count; ++index)
        x = collide_with(collider, params.collider_first + index, x,
                         vec3_of(prev.x, prev.y, prev.z));
    position[item] = (float4)(x.x, x.y, x.z, before.w);
}
