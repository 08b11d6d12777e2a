/* articulated: one substep of an inextensible rod.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, lane_rest, collider.
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

/* Lanes that want Newton step `k`; no strand depends on those that share its work-item. */
static inline mask articulated_wants(const rod_problem* rod, const rod_state* s, uint iterations,
                                     uint k, mask moved) {
    const mask none = (real)(0.0f) > (real)(0.0f);
    if (k < iterations)
        return !none;
    mask wants = none;
    if (rod->step->pin && k < PLAIT_ARTICULATED_PIN_STEPS)
        wants = articulated_unpinned(rod, s);
    if (!rod->contacts || k >= PLAIT_ARTICULATED_DEEP_STEPS || !any_lane(rod->contacts->lanes))
        return wants;
    const mask restless =
        k < PLAIT_ARTICULATED_CONTACT_STEPS
            ? moved | rod->contacts->changed
            : articulated_deeper(rod, s, PLAIT_ARTICULATED_DEEP - PLAIT_CONTACT_MAX_PENETRATION);
    return wants | (rod->contacts->lanes & restless);
}

/* The steps with the contacts of the substep before, from the start, whose level is known: one, and a
 * second where something slides, a third where that was turned back or the second was not enough. Returns
 * the lanes that are not solved. */
static inline mask articulated_warm(const rod_problem* rod, rod_state* s, articulated_level start,
                                    contact_warm* warm) {
    const mask none = (real)(0.0f) > (real)(0.0f), apart = !warm->which;
    articulated_level level = start;
    for (uint k = 0; k < PLAIT_CONTACT_WARM_STEPS && any_lane(warm->which); ++k) {
        if (k > 0) {
            warm->deep = warm->back = none;
            warm_press(warm, s->x);
            level = articulated_level_of(rod, s);
        }
        warm->contacts->now &= !warm->which;
        articulated_newton(rod, s, level, warm->which, warm);
        const mask slips = warm_rub(warm, s->x);
        mask again = warm->deep;
        if (k == 0)
            again |= warm->pressed & slips;
        if (k == 1)
            again |= warm->back;
        warm->which &= again;
    }
    if (rod->step->pin)
        warm->deep |= articulated_unpinned(rod, s);
    return apart | warm->deep;
}

/* From the start, whose level is known, but for contacts that were found since. Lanes that take no
 * further step are put back off what they are too deep in. `warm`: null, or what contacts begin with. */
static inline void articulated_solve(const rod_problem* rod, rod_state* s, articulated_level start,
                                     uint iterations, contact_warm* warm) {
    mask takes = (real)(0.0f) == (real)(0.0f);
    if (warm) {
        const mask left = articulated_warm(rod, s, start, warm);
        takes = iterations > 1u ? takes : left;
    }
    const mask loops = takes;
    mask moved = takes, renews = takes;
    uint back = 0;
    for (uint k = 0;; ++k) {
        if (rod->contacts && any_lane(renews))
            contact_renew_lanes(rod->contacts, s->x, renews);
        takes &= articulated_wants(rod, s, iterations, k, moved);
        if (any_lane(takes)) {
            const int known = k == 0 && !rod->contacts;
            const articulated_level level = known ? start : articulated_level_of(rod, s);
            moved = articulated_newton(rod, s, level, takes, 0);
            renews = takes;
        } else {
            if (!rod_in_contact(rod) || rod->contacts->params->planes > 1u ||
                back++ == PLAIT_ARTICULATED_PUT_BACK)
                return;
            renews = articulated_put_back(rod, s, loops);
            if (!any_lane(renews))
                return;
        }
    }
}

__kernel void plait_articulated(const uint item_count, const plait_lane_params params,
                                __global const uint* lane_strand, __global const float4* rest,
                                __global const float4* pose, __global const real* lane_material,
                                __global const real* lane_rest, __global const float4* collider,
                                __global const real* lane_acceleration,
                                __global const real* lane_pin, __global const real* lane_plane,
                                __global real* lane_x, __global real* lane_v, __global real* lane_q,
                                __global real* lane_q_before, __global real* lane_x_before,
                                __global real* lane_v_before, __global real* lane_normal_force) {
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
    contacts.v = lane_v;
    const rod_problem rod =
        rod_problem_of(&step, y, lane_rest, contact_may_be(&params) ? &contacts : 0);
    articulated_load(&rod, &s, state, lane_q);
    contact_warm warm;
    const int warms = rod.contacts && params.iterations > 0 &&
                      warm_begin(&warm, &contacts, y, lane_normal_force, lane_v_before);
    const articulated_level start = articulated_start(&rod, &s, state, lane_q);
    articulated_solve(&rod, &s, start, params.iterations, warms ? &warm : 0);
    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before);
    if (rod.contacts)
        warm_store(&contacts, lane_normal_force);
}
