/* collide: push free vertices out of tapered capsules, with Coulomb friction.
 *
 * Items   vertices.
 * Reads   vertex_count, capsule (both ends of its step), position_prev.
 * Moves   position.
 * Source  TressFX 4.1 (cone between two spheres); friction as in position-based dynamics, Macklin
 * et al. 2014, section 6.1, on the displacement of the step. Changed the normal is that of the hull
 * of the two spheres, so cone and ends meet without a crease; the capsule moves within the step,
 * and friction acts relative to its surface: the motion of the axis at the contact (a spin about
 * the axis itself is not seen). Friction is bounded by coefficient * push and never reverses the
 * slip. Limit   a vertex is tested where it is, not along its way: see docs/stages/collide.md. */
#pragma OPENCL FP_CONTRACT OFF
#include "common/capsule.clh"
#include "common/strand.clh"

static float3 collide_with(__global const float4* capsules, uint index,
                           const plait_collide_params* params, float3 x, float3 prev) {
    const capsule_t now = capsule_at(capsules, index, params->alpha_to);
    if (!capsule_may_hold(now, x))
        return x;
    const contact_t contact = capsule_contact(now, x);
    if (!(contact.distance < 0.0f))
        return x;
    const float depth = -contact.distance;
    const float3 pushed = x + depth * contact.normal;
    const capsule_t before = capsule_at(capsules, index, params->alpha_from);
    const float3 surface =
        capsule_axis_point(now, contact.foot) - capsule_axis_point(before, contact.foot);
    const float3 slip = (pushed - prev) - surface;
    return pushed + coulomb(slip, contact.normal, depth, capsule_friction(capsules, index));
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
        x = collide_with(capsule, index, &params, x, position_prev[item].xyz);
    position[item] = (float4)(x, before.w);
}
