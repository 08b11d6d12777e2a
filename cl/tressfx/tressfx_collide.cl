/* tressfx_collide: push free vertices out of colliders, with Coulomb friction.
 *
 * Items   vertices.
 * Reads   vertex_count, collider (both ends of its step), position_prev.
 * Moves   position.
 * Source  TressFX 4.1 (cone between two spheres); friction as in position-based dynamics, Macklin
 * et al. 2014, section 6.1, on the displacement of the step. Changed the normal is that of the hull
 * of the two spheres, so cone and ends meet without a crease; the capsule moves within the step,
 * and friction acts relative to its surface, which turns with it. Friction is bounded by
 * coefficient * push and never reverses the slip. Limit   a vertex is tested where it is, not along
 * its way: see docs/stages/tressfx.md#tressfx_collide. */
#pragma OPENCL FP_CONTRACT OFF
#include "base/strand.clh"
#include "contact/collider.clh"

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
    const lane_gap gap = collider_gap(colliders, index, x);
    if (!(gap.distance < 0.0f))
        return x;
    const vec3 pushed = axpy3(-gap.distance, gap.normal, x);
    const vec3 slip = sub3(collider_carry_back(colliders, index, pushed), prev);
    const float friction = lane_collider_friction(colliders, index);
    return add3(pushed, coulomb(slip, gap.normal, -gap.distance, friction));
}

__kernel void
plait_tressfx_collide(const uint item_count, const plait_tressfx_collide_params params,
                      __global const uint* vertex_count, __global const float4* collider,
                      __global const float4* position_prev, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 before = position[item];
    const uint strand = item / params.vertex_stride;
    if (item % params.vertex_stride >= vertex_count[strand] || !is_free(before))
        return;
    const vec3 prev = unpack3(position_prev[item]);
    vec3 x = unpack3(before);
    for (uint index = 0u; index < params.collider_count; ++index)
        x = collide_with(collider, params.collider_first + index, x, prev);
    position[item] = pack3(x, before.w);
}
