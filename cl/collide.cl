/* collide: push free vertices out of colliders, with Coulomb friction.
 *
 * Items   vertices.
 * Reads   vertex_count, capsule (both ends of its step), position_prev.
 * Moves   position.
 * Source  TressFX 4.1 (cone between two spheres); friction as in position-based dynamics, Macklin
 * et al. 2014, section 6.1, on the displacement of the step. Changed the normal is that of the hull
 * of the two spheres, so cone and ends meet without a crease; the capsule moves within the step,
 * and friction acts relative to its surface, which turns with it. Friction is bounded by
 * coefficient * push and never reverses the slip. Limit   a vertex is tested where it is, not along
 * its way: see docs/stages/collide.md. */
#pragma OPENCL FP_CONTRACT OFF
#include "common/collider.clh"
#include "common/strand.clh"

static inline float3 collide_with(__global const float4* colliders, uint index, float3 x,
                                  float3 prev) {
    const contact_t contact = collider_contact(colliders, index, x);
    if (!(contact.distance < 0.0f))
        return x;
    const float depth = -contact.distance;
    const float3 pushed = x + depth * contact.normal;
    const float3 slip = collider_carry_back(colliders, index, pushed) - prev;
    return pushed + coulomb(slip, contact.normal, depth, collider_friction(colliders, index));
}

__kernel void plait_collide(const uint item_count, const plait_collide_params params,
                            __global const uint* vertex_count, __global const float4* capsule,
                            __global const float4* position_prev, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 before = position[item];
    const uint strand = item / params.vertex_stride;
    if (item % params.vertex_stride >= vertex_count[strand] || !is_free(before))
        return;
    float3 x = before.xyz;
    for (uint index = 0u; index < params.collider_count; ++index)
        x = collide_with(capsule, params.collider_first + index, x, position_prev[item].xyz);
    position[item] = (float4)(x, before.w);
}
