/* Baseline: an inextensible chain without bending.
 *
 * Source  inertial targets; K tridiagonal length solves (Han & Harada 2013); one exact
 *         follow-the-leader sweep with the velocity correction of Mueller et al. 2012, of which
 *         K = 0 is the dynamic follow-the-leader.
 * Changed the first length solve has its tension implicit where the step is coarse
 *         (chain_tension.clh); the velocity correction counts the sweep's displacement
 *         alone.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "chain_tension.clh"
#include "constants.clh"
#include "kernel.clh"
#include "strands/energy.clh"

/* Project x on linearised edge lengths: J W J^T lambda = C, C capped at one rest length; W is the
 * inverse mass, less where contacts hold. Past the tip there is no constraint: lambda is 0. */
static inline void chain_solve_lengths(const lane_step* step, const lane_contacts* contacts,
                                       const chain_mobility* hold, vec3* x) {
    vec3 u[PLAIT_VERTICES];
    real upper[PLAIT_VERTICES], lambda[PLAIT_VERTICES];
    const int touches = hold != 0;
    const vec3 down = vec3_of((real)(0.0f), (real)(-1.0f), (real)(0.0f));
    real w0 = (real)(0.0f); /* the root is pinned */
    for (int i = 0; i < step->segments; ++i) {
        const real rest = lane_material_at(step, i, PLAIT_LANE_LENGTH);
        const real w1 = 1.0f / chain_mass(step, i + 1);
        const vec3 edge = sub3(x[i + 1], x[i]);
        u[i] = unit3(edge, down);
        real residual = fmin(dot3(edge, u[i]) - rest, rest);
        residual = pick(rest > (real)(0.0f), residual, (real)(0.0f)); /* past the tip */
        const real one = (real)(1.0f);
        real diagonal = touches ? chain_inverse_mass(contacts, hold, i, u[i], u[i], one) +
                                      chain_inverse_mass(contacts, hold, i + 1, u[i], u[i], one)
                                : w0 + w1;
        if (i > 0) {
            const real cosine = dot3(u[i - 1], u[i]);
            real lower = touches ? -chain_inverse_mass(contacts, hold, i, u[i - 1], u[i], cosine)
                                 : -cosine * w0;
            lower = pick(rest > (real)(0.0f), lower, (real)(0.0f));
            diagonal -= lower * upper[i - 1];
            residual -= lower * lambda[i - 1];
        }
        real next = (real)(0.0f);
        if (i + 1 < step->segments) {
            const vec3 onward = unit3(sub3(x[i + 2], x[i + 1]), down);
            const real cosine = dot3(u[i], onward);
            next = touches ? -chain_inverse_mass(contacts, hold, i + 1, u[i], onward, cosine)
                           : -cosine * w1;
            next = pick(chain_ends(step, i), (real)(0.0f), next);
        }
        upper[i] = next / diagonal;
        lambda[i] = residual / diagonal;
        w0 = w1;
    }
    for (int i = step->segments - 2; i >= 0; --i)
        lambda[i] -= upper[i] * lambda[i + 1];
    for (int i = 1; i <= step->segments; ++i) {
        vec3 pull = scale3(u[i - 1], -lambda[i - 1]);
        if (i < step->segments)
            pull = axpy3(lambda[i], u[i], pull);
        if (touches)
            x[i] = add3(chain_apply_mobility(contacts, hold, i, pull), x[i]);
        else
            x[i] = axpy3(1.0f / chain_mass(step, i), pull, x[i]);
    }
}

/* Lanes with a vertex whose pin is far stiffer than its inertia. */
static inline mask chain_pinned(const lane_step* step) {
    mask pinned = (real)(0.0f) > (real)(0.0f);
    for (int i = 1; i <= step->segments && step->pin; ++i)
        pinned |= lane_pin_stiffness(step, i) > CHAIN_PIN_STIFFNESS * lane_inertia(step) *
                                                    lane_material_at(step, i, PLAIT_LANE_MASS);
    return pinned;
}

/* K solves; those of strands in `pulled` had their first with an implicit tension, those in
 * `pinned` get CHAIN_PIN_SOLVES at least. */
static inline void chain_iterate_lengths(const lane_step* step, const lane_contacts* contacts,
                                         const chain_mobility* hold, uint iterations, mask pulled,
                                         mask pinned, vec3* x) {
    vec3 kept[PLAIT_VERTICES];
    const mask all = (real)(0.0f) == (real)(0.0f);
    const uint most = any_lane(pinned) ? max(iterations, (uint)CHAIN_PIN_SOLVES) : iterations;
    for (uint k = 0; k < most; ++k) {
        mask takes = k < iterations ? all : pinned;
        if (k == 0)
            takes &= !pulled;
        if (!any_lane(takes))
            continue;
        const int some = any_lane(!takes);
        for (int i = 1; i <= step->segments && some; ++i)
            kept[i] = x[i];
        chain_solve_lengths(step, contacts, hold, x);
        for (int i = 1; i <= step->segments && some; ++i)
            x[i] = pick3(takes, x[i], kept[i]);
    }
}

/* Exact lengths, root to tip. */
static inline void chain_follow_leader(const lane_step* step, const lane_contacts* contacts,
                                       vec3* x) {
    const vec3 down = vec3_of((real)(0.0f), (real)(-1.0f), (real)(0.0f));
    const int touches = contacts && contacts->touching;
    for (int i = 0; i < step->segments; ++i) {
        const real length = lane_material_at(step, i, PLAIT_LANE_LENGTH);
        const vec3 exact = axpy3(length, unit3(sub3(x[i + 1], x[i]), down), x[i]);
        x[i + 1] =
            touches ? chain_hold_depth(contacts, i + 1, x[i], length, x[i + 1], exact) : exact;
    }
}

/* The same, off the colliders; again for strands that it pulled through one. */
static inline void chain_follow_leader_in_contact(const lane_step* step, lane_contacts* contacts,
                                                  vec3* x) {
    vec3 first[PLAIT_VERTICES];
    contact_renew(contacts, x);
    chain_follow_leader(step, contacts, x);
    contact_renew(contacts, x);
    mask crossed = (real)(0.0f) > (real)(0.0f);
    for (int i = 1; i <= step->segments && contacts->touching; ++i) {
        crossed |= contact_excess(contacts, i, x[i]) > (real)(0.0f);
        first[i] = x[i];
    }
    if (!any_lane(crossed))
        return;
    chain_follow_leader(step, contacts, x);
    for (int i = 1; i <= step->segments; ++i)
        x[i] = pick3(crossed, x[i], first[i]);
}

/* x, from `target` on, on its lengths; in some rounds where contacts hold it, so that pushes and
 * slip agree with the lengths. Strands that touch nothing, also not where the first round puts
 * them, leave after it. */
static inline void chain_solve(const lane_step* step, lane_contacts* contacts, uint iterations,
                               mask pulled, const vec3* target, vec3* x) {
    vec3 before[PLAIT_VERTICES];
    chain_mobility hold[PLAIT_VERTICES];
    const mask all = (real)(0.0f) == (real)(0.0f);
    const int rounds = contacts ? CHAIN_CONTACT_ROUNDS : 1;
    for (int round = 0; round < rounds; ++round) {
        mask touched = !all;
        if (contacts) {
            contact_renew(contacts, x);
            touched = contacts->lanes;
        }
        const int touches = any_lane(touched);
        if (round > 0 && !touches)
            break;
        for (int i = 1; i <= step->segments && touches; ++i)
            before[i] = x[i];
        if (touches) {
            chain_mobilities(contacts, x, hold);
            chain_free_positions(contacts, hold, target, x);
        }
        chain_iterate_lengths(step, contacts, touches ? hold : 0, iterations, pulled & !touched,
                              chain_pinned(step), x);
        const mask takes = round == 0 ? all : touched;
        for (int i = 1; i <= step->segments && touches; ++i)
            x[i] = pick3(takes, x[i], before[i]);
    }
}

__kernel void plait_articulated(BASELINE_ARGUMENTS) {
    HOLD_IDLE_LOCAL(item_count, lane_x)
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    vec3 x[PLAIT_VERTICES], y[PLAIT_VERTICES], w[PLAIT_VERTICES], solved[PLAIT_VERTICES];
    vec3 target[PLAIT_VERTICES]; /* y, or where tension pulls it */
    lane_predict(&step, &params, state, y, w);
    for (int i = 0; i <= step.segments; ++i)
        target[i] = y[i];
    mask pulled = (real)(0.0f) > (real)(0.0f);
    if (params.iterations > 0 && !params.bdf2)
        pulled = chain_is_coarse(&step, &params);
    if (any_lane(pulled))
        chain_pull(&step, lane_x, pulled, target);
    for (int i = 0; i <= step.segments; ++i)
        x[i] = target[i];

    contact_loop of_step;
    lane_contacts* contacts = contact_may_be(&params) ? &of_step.contacts : 0;
    if (contacts)
        contact_loop_begin(&of_step, &step, &params, collider, lane_plane, lane_x);
    chain_solve(&step, contacts, params.iterations, pulled, target, x);
    for (int i = 0; i <= step.segments; ++i)
        solved[i] = x[i];
    if (contacts)
        chain_follow_leader_in_contact(&step, contacts, x);
    else
        chain_follow_leader(&step, 0, x);

    for (int i = 1; i <= step.segments; ++i) {
        /* the sweep moved vertex i+1 as if pulled by i: i recoils */
        if (i < step.segments) {
            const real recoil = (real)(-CHAIN_VELOCITY_CORRECTION / step.h);
            w[i] = axpy3(pick(chain_ends(&step, i - 1), (real)(0.0f), recoil),
                         sub3(x[i + 1], solved[i + 1]), w[i]);
        }
    }
    lane_velocities(&step, x, y, w);
    real given = (real)(0.0f);
    if (contacts) /* the sweep is exact in lengths alone: springs that it pressed give nothing */
        given = energy_of_contacts(contacts, state, x) -
                fmax(energy_of_springs(contacts, x), (real)(0.0f));
    const mask pairs = energy_pairs(&step, &params, state);
    const energy_limits limits = energy_limit(&step, &params, state, pairs, given, x, w);
    lane_store_root(&step, state);
    for (int i = 1; i <= step.segments; ++i)
        if (contacts && contacts->touching)
            contact_store(contacts, state, i, x[i], w[i]);
        else
            lane_store(&step, state, i, x[i], w[i]);
    energy_limit_before(&step, state, limits);
}
