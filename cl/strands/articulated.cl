/* articulated: one substep of an inextensible rod.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, lane_rest, collider,
 *         lane_plane, lane_hollow.
 * Moves   lane_x, lane_v, lane_q, and the steps before; lane_normal_force.
 * Source  strands/articulated.clh: the potential, the recursion, and what of both is ours.
 */
#pragma OPENCL FP_CONTRACT ON
#include "strands/articulated.clh"

/* Lanes with a vertex that its pin, far stiffer than its inertia, has not got to. */
static inline mask articulated_unpinned(const rod_problem* rod, const rod_state* s) {
    mask off = (real)(0.0f) > (real)(0.0f);
    for (int i = 1; i <= rod->step->segments; ++i) {
        const quat pin = loadq(rod->step->pin, rod->step->place, i);
        const vec3 way = sub3(vec3_of(pin.x, pin.y, pin.z), s->x[i]);
        const real little = PLAIT_ARTICULATED_PIN_DISTANCE * articulated_length(rod, i - 1);
        off |= (pin.w > PLAIT_ARTICULATED_PIN_STIFFNESS * articulated_inertia(rod, i)) &
               (dot3(way, way) > little * little);
    }
    return off;
}

/* Lanes that want Newton step k; no strand depends on those that share its work-item. In contact: the first in any
 * case, a second of what slides, a third of what that turned back, and more of what is deep in a body. Strands that
 * meet push each other about with more. */
static inline mask articulated_wants(const rod_problem* rod, const rod_state* s, uint iterations,
                                     uint k, const contact_placer* placer) {
    const mask none = (real)(0.0f) > (real)(0.0f);
    mask wants = none;
    if (k < iterations || (placer && k == 0))
        return !none;
    if (rod->step->pin && k < PLAIT_ARTICULATED_PIN_STEPS)
        wants = articulated_unpinned(rod, s);
    if (!placer)
        return wants;
    if (k < PLAIT_CONTACT_MAX_STEPS)
        wants |= placer->deep;
    if (!contact_meets(rod->contacts) && k == 1)
        wants |= placer->pressed & placer->slips;
    if (!contact_meets(rod->contacts) && k == 2)
        wants |= placer->back;
    return wants;
}

/* From the start, whose level is known. `placer`: null, or what places vertices. All steps are those of one call: what rests
 * beside a body rests to the bit as it does without. */
static inline void articulated_solve(const rod_problem* rod, rod_state* s, articulated_level start,
                                     uint iterations, contact_placer* placer) {
    mask takes = (real)(0.0f) == (real)(0.0f);
    for (uint k = 0;; ++k) {
        takes &= articulated_wants(rod, s, iterations, k, placer);
        if (!any_lane(takes))
            return;
        articulated_level level = start;
        if (k > 0) {
            if (placer)
                placer_again(placer, k, takes, s->x);
            level = articulated_level_of(rod, s);
        }
        articulated_newton(rod, s, level, takes, placer);
    }
}

__kernel PLAIT_WIDE void
plait_articulated(const uint item_count, const plait_lane_params params,
                  __global const uint* lane_strand, __global const float4* rest,
                  __global const float4* pose, __global const real* lane_material,
                  __global const real* lane_rest, __global const float4* collider,
                  __global const real* lane_acceleration, __global const real* lane_pin,
                  __global const real* lane_plane, __global real* lane_x, __global real* lane_v,
                  __global real* lane_q, __global real* lane_q_before, __global real* lane_x_before,
                  __global real* lane_v_before, __global real* lane_normal_force,
                  __global const real* lane_hollow) {
    HOLD_IDLE_LOCAL(item_count, lane_x)
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    rod_state s;
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    lane_contacts contacts;
    contact_begin(&contacts, &step, &params, collider, lane_plane, lane_x);
    contacts.nearby.hollow = params.hollows ? lane_hollow : 0;
    contact_aim(&contacts, y);
    const rod_problem rod =
        rod_problem_of(&step, y, lane_rest, contact_may_be(&params) ? &contacts : 0);
    articulated_load(&rod, &s, state, lane_q);
    contact_placer placer;
    const int places =
        rod.contacts && placer_begin(&placer, &contacts, lane_normal_force, lane_v, lane_v_before);
    const articulated_level start = articulated_start(&rod, &s, state, lane_q);
    articulated_solve(&rod, &s, start, params.iterations, places ? &placer : 0);
    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before);
    if (rod.contacts)
        placer_store(&contacts, lane_normal_force);
}
