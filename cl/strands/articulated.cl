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

/* Before step k with the contacts of the substep before: one, and a second where something slides, a third
 * where that was turned back or the second was not enough. Returns whether any lane takes it. */
static inline int articulated_begins(rod_state* s, uint k, contact_warm* warm) {
    if ((k >= PLAIT_CONTACT_WARM_STEPS && !PLAIT_STRANDS_MEET) || !any_lane(warm->which))
        return 0;
    if (k > 0) {
        warm->deep = warm->slips = warm->back = warm->deep & !warm->deep;
        warm_press(warm, s->x);
    }
    warm->contacts->now &= !warm->which;
    return 1;
}

/* Where strands meet: the lanes that take step k, which is one more only while they are deep in a body. With
 * more, strands push each other about. */
static inline mask articulated_again(const rod_problem* rod, const rod_state* s, uint iterations,
                                     uint k, const contact_warm* warm) {
    if (k < iterations)
        return warm->which;
    mask again = k < PLAIT_ARTICULATED_CONTACT_STEPS ? warm->deep : warm->deep & !warm->deep;
    if (rod->step->pin && k < PLAIT_ARTICULATED_PIN_STEPS)
        again |= articulated_unpinned(rod, s);
    return again;
}

/* After it: lanes that take another one. */
static inline void articulated_ends(const rod_problem* rod, const rod_state* s, uint iterations,
                                    uint k, contact_warm* warm) {
    if (PLAIT_STRANDS_MEET) {
        warm->which &= articulated_again(rod, s, iterations, k + 1, warm);
        return;
    }
    mask again = warm->deep;
    if (k == 0)
        again |= warm->pressed & warm->slips;
    if (k == 1)
        again |= warm->back;
    warm->which &= again & !warm->wild;
}

/* From the start, whose level is known, but for contacts that were found since. Lanes that take no
 * further step are put back off what they are too deep in. `warm`: null, or what contacts begin with. All
 * steps are those of one call: what rests beside a body rests to the bit as it does without. */
static inline void articulated_solve(const rod_problem* rod, rod_state* s, articulated_level start,
                                     uint iterations, contact_warm* warm) {
    const mask all = (real)(0.0f) == (real)(0.0f);
    const mask apart = warm ? !warm->which : all;
    mask takes = all, loops = all, moved = all, renews = all;
    uint back = 0, k = 0;
    for (;;) {
        if (warm && !articulated_begins(s, k, warm)) {
            if (PLAIT_STRANDS_MEET)
                return;
            if (rod->step->pin)
                warm->deep |= articulated_unpinned(rod, s);
            if (iterations < 2u)
                takes = apart | warm->wild | warm->deep;
            loops = moved = renews = takes;
            warm = 0;
            k = 0;
        }
        if (!warm) {
            if (rod->contacts && any_lane(renews))
                contact_renew_lanes(rod->contacts, s->x, renews);
            takes &= articulated_wants(rod, s, iterations, k, moved);
            if (!any_lane(takes)) {
                if (!rod_in_contact(rod) || back++ == PLAIT_ARTICULATED_PUT_BACK)
                    return;
                renews = articulated_put_back(rod, s, loops);
                if (!any_lane(renews))
                    return;
                ++k;
                continue;
            }
            renews = takes;
        }
        articulated_level level = start;
        if (warm ? k > 0 : k > 0 || rod->contacts)
            level = articulated_level_of(rod, s);
        moved = articulated_newton(rod, s, level, warm ? warm->which : takes, warm);
        if (warm)
            articulated_ends(rod, s, iterations, k, warm);
        ++k;
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
    contact_aim(&contacts, y);
    const rod_problem rod =
        rod_problem_of(&step, y, lane_rest, contact_may_be(&params) ? &contacts : 0);
    articulated_load(&rod, &s, state, lane_q);
    contact_warm warm;
    const int warms = (PLAIT_STRANDS_MEET || (rod.contacts && params.iterations > 0)) &&
                      warm_begin(&warm, &contacts, lane_normal_force, lane_v_before);
    const articulated_level start = articulated_start(&rod, &s, state, lane_q);
    articulated_solve(&rod, &s, start, params.iterations, warms ? &warm : 0);
    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before);
    if (rod.contacts)
        warm_store(&contacts, lane_normal_force);
}
