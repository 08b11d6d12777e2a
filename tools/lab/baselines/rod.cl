/* Baseline: a Cosserat rod by damped Gauss-Newton with a direct solve.
 *
 * Source  the potential of stretch_rod.clh; unknowns per segment k are the displacement of vertex
 * k+1 and the rotation vector of q_k, so the Hessian is block tridiagonal, 6x6. Gauss-Newton plus
 *         the geometric term of tension, without which it diverges; backtracking on the potential;
 *         one iteration of `cosserat` before, two where the search fails.
 */
#pragma OPENCL FP_CONTRACT ON
#include "constants.clh"
#include "cosserat.clh"
#include "kernel.clh"

#define ROD_UNKNOWNS                                                                               \
    6 /* loops over them have constant bounds, so that all compilers unroll them                   \
       */

/* What one segment adds: tension ks (edge - l t), director, EA and the gradients it causes. */
typedef struct {
    vec3 director, tension;
    real pull;      /* EA, N */
    real geometric; /* max(0, l t.tension), N m */
    real stretch, bend, length;
} rod_segment;

static inline rod_segment rod_segment_at(const rod_problem* rod, const rod_state* s, int k) {
    rod_segment e;
    e.length = rod_material(rod, k, PLAIT_LANE_LENGTH);
    e.stretch = rod_material(rod, k, PLAIT_LANE_STRETCH);
    e.bend = rod_material(rod, k, PLAIT_LANE_BEND);
    e.director = director(s->q[k]);
    const vec3 edge = sub3(s->x[k + 1], s->x[k]);
    e.tension = scale3(sub3(edge, scale3(e.director, e.length)), e.stretch);
    e.pull = e.stretch * e.length;
    e.geometric = fmax(e.length * dot3(e.director, e.tension), (real)(0.0f));
    return e;
}

/* W of a joint, N m: what its moment on either segment's turn is linear in; k/4 I where it is
 * round. */
static inline sym3 rod_joint_stiffness(const rod_problem* rod, const rod_state* s, int k,
                                       real bend) {
    const real round = 0.25f * bend, zero = (real)(0.0f);
    const sym3 w = {round, round, round, zero, zero, zero};
    const rod_section section = rod_section_of(rod, k);
    if (rod_section_round(section))
        return w;
    const quat expected = rod_expected(rod, s, k);
    const vec3 across = rotate3(expected, vec3_of(zero, zero, (real)(1.0f)));
    return add_outer(add_outer(w, 0.25f * section.twist, director(expected)), 0.25f * section.cross,
                     across);
}

/* Lower triangle of the diagonal block of segment k; `own` and `next` are W of its joints, those of
 * segment k+1 0 at the tip. */
static inline void rod_diagonal(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], const rod_segment* e,
                                real inertia, real next_stretch, sym3 own, sym3 next) {
    const vec3 t = e->director;
    const real turn = e->pull * e->length + e->geometric;
    const real zero = (real)(0.0f);
    a[0][0] = a[1][1] = a[2][2] = inertia + e->stretch + next_stretch;
    a[1][0] = a[2][0] = a[2][1] = zero;
    /* rows omega, columns x: EA [t]x transposed */
    a[3][0] = a[4][1] = a[5][2] = zero;
    a[3][1] = e->pull * t.z;
    a[3][2] = -e->pull * t.y;
    a[4][0] = -e->pull * t.z;
    a[4][2] = e->pull * t.x;
    a[5][0] = e->pull * t.y;
    a[5][1] = -e->pull * t.x;
    /* I - t t^T without a difference: along t limp hair's twist is a millionth of `turn` */
    a[3][3] = own.xx + next.xx + turn * (t.y * t.y + t.z * t.z);
    a[4][3] = own.xy + next.xy - turn * t.y * t.x;
    a[4][4] = own.yy + next.yy + turn * (t.x * t.x + t.z * t.z);
    a[5][3] = own.xz + next.xz - turn * t.z * t.x;
    a[5][4] = own.yz + next.yz - turn * t.z * t.y;
    a[5][5] = own.zz + next.zz + turn * (t.x * t.x + t.y * t.y);
}

/* Adds the contact of vertex i. */
static inline void rod_diagonal_contact(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], const rod_problem* rod,
                                        const rod_state* s, int i) {
    sym3 h = {a[0][0], a[1][1], a[2][2], a[1][0], a[2][0], a[2][1]};
    h = add_contact(h, &rod->contacts->at[i], contact_term_at(rod->contacts, i, s->x[i]));
    a[0][0] = h.xx;
    a[1][1] = h.yy;
    a[2][2] = h.zz;
    a[1][0] = h.xy;
    a[2][0] = h.xz;
    a[2][1] = h.yz;
}

/* The block B between segments k-1 (rows) and k (columns): [-ks I, -EA [t]x; 0, -W]. */
typedef struct {
    real stretch;
    vec3 pull; /* EA t */
    sym3 turn; /* W */
    int round; /* W is turn.xx I */
} rod_coupling;

/* W v */
static inline vec3 rod_coupling_turn(const rod_coupling* b, vec3 v) {
    return b->round ? scale3(v, b->turn.xx) : mul_sym3(b->turn, v);
}

/* Column c of B. */
static inline void rod_coupling_column(const rod_coupling* b, int c, real v[ROD_UNKNOWNS]) {
    const real zero = (real)(0.0f);
    const vec3 axis = vec3_of((real)(c % 3 == 0), (real)(c % 3 == 1), (real)(c % 3 == 2));
    const vec3 none = vec3_of(zero, zero, zero);
    const vec3 x = c < 3 ? scale3(axis, -b->stretch) : cross3(axis, b->pull);
    const vec3 w = c < 3 ? none : scale3(rod_coupling_turn(b, axis), (real)(-1.0f));
    v[0] = x.x;
    v[1] = x.y;
    v[2] = x.z;
    v[3] = w.x;
    v[4] = w.y;
    v[5] = w.z;
}

/* to -= B^T (x, w), v of the one segment and `to` of the next: (ks x, x x EA t + W w), each product
 * into the sum, where it cancels, and not into another of its size. */
static inline void rod_coupling_back(const rod_coupling* b, const real v[ROD_UNKNOWNS],
                                     real to[ROD_UNKNOWNS]) {
    const vec3 t = b->pull;
    to[0] += b->stretch * v[0];
    to[1] += b->stretch * v[1];
    to[2] += b->stretch * v[2];
    to[3] += v[1] * t.z;
    to[3] -= v[2] * t.y;
    to[4] -= v[0] * t.z;
    to[4] += v[2] * t.x;
    to[5] += v[0] * t.y;
    to[5] -= v[1] * t.x;
    const sym3 w = b->turn;
    if (b->round) {
        to[3] += w.xx * v[3];
        to[4] += w.xx * v[4];
        to[5] += w.xx * v[5];
        return;
    }
    to[3] += w.xx * v[3] + w.xy * v[4] + w.xz * v[5];
    to[4] += w.xy * v[3] + w.yy * v[4] + w.yz * v[5];
    to[5] += w.xz * v[3] + w.yz * v[4] + w.zz * v[5];
}

/* a = L L^T in place, the inverse pivots on the diagonal; 0 where rounding took one, as the twist
 * of long limp strands': that unknown stays. */
static inline void rod_factor(real a[ROD_UNKNOWNS][ROD_UNKNOWNS]) {
#pragma unroll
    for (int c = 0; c < ROD_UNKNOWNS; ++c) {
        real pivot = a[c][c];
#pragma unroll
        for (int k = 0; k < ROD_UNKNOWNS; ++k)
            if (k < c)
                pivot -= a[c][k] * a[c][k];
        a[c][c] = pick(pivot > (real)(1e-30f), rsqrt(fmax(pivot, (real)(1e-30f))), (real)(0.0f));
#pragma unroll
        for (int r = 0; r < ROD_UNKNOWNS; ++r)
            if (r > c) {
                real sum = a[r][c];
#pragma unroll
                for (int k = 0; k < ROD_UNKNOWNS; ++k)
                    if (k < c)
                        sum -= a[r][k] * a[c][k];
                a[r][c] = sum * a[c][c];
            }
    }
}

/* v = (L L^T)^-1 v, of which the elements before `first` are 0. */
static inline void rod_back_substitute(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], real v[ROD_UNKNOWNS],
                                       int first) {
#pragma unroll
    for (int r = 0; r < ROD_UNKNOWNS; ++r)
        if (r >= first) {
#pragma unroll
            for (int k = 0; k < ROD_UNKNOWNS; ++k)
                if (k >= first && k < r)
                    v[r] -= a[r][k] * v[k];
            v[r] *= a[r][r];
        }
#pragma unroll
    for (int i = 0; i < ROD_UNKNOWNS; ++i) {
        const int r = ROD_UNKNOWNS - 1 - i;
#pragma unroll
        for (int k = 0; k < ROD_UNKNOWNS; ++k)
            if (k > r)
                v[r] -= a[k][r] * v[k];
        v[r] *= a[r][r];
    }
}

/* Minus the gradient for segment k; `next` is segment k+1 or null at the tip. */
static inline void rod_descent(const rod_problem* rod, const rod_state* s, int k,
                               const rod_segment* e, const rod_segment* next,
                               real g[ROD_UNKNOWNS]) {
    const int i = k + 1;
    const real inertia = rod_hold(rod, i);
    vec3 force = sub3(scale3(sub3(rod->y[i], s->x[i]), inertia), e->tension);
    vec3 torque = scale3(cross3(e->director, e->tension), e->length);
    const quat expected = rod_expected(rod, s, k);
    torque = add3(torque, rod_joint_moment(rod, s, k, expected, e->bend));
    if (next) {
        const quat onward = rod_expected(rod, s, k + 1);
        force = add3(force, next->tension);
        torque = sub3(torque, rod_joint_moment(rod, s, k + 1, onward, next->bend));
    }
    if (rod_in_contact(rod))
        force = add3(force, contact_term_at(rod->contacts, i, s->x[i]).force);
    g[0] = force.x;
    g[1] = force.y;
    g[2] = force.z;
    g[3] = torque.x;
    g[4] = torque.y;
    g[5] = torque.z;
}

/* What elimination keeps of a segment: u_k = z - sum over c of next[c] u_(k+1)[c]. */
typedef struct {
    real z[ROD_UNKNOWNS];
    real next[ROD_UNKNOWNS][ROD_UNKNOWNS]; /* columns */
} rod_row;

/* Eliminate row k-1 from row k: a -= B^T X, g -= B^T z. */
static inline void rod_eliminate(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], real g[ROD_UNKNOWNS],
                                 const rod_coupling* b, const rod_row* before) {
    rod_coupling_back(b, before->z, g);
#pragma unroll
    for (int c = 0; c < ROD_UNKNOWNS; ++c) {
        real column[ROD_UNKNOWNS]; /* what is above the diagonal is not read */
#pragma unroll
        for (int r = 0; r < ROD_UNKNOWNS; ++r)
            column[r] = r < c ? (real)(0.0f) : a[r][c];
        rod_coupling_back(b, before->next[c], column);
#pragma unroll
        for (int r = 0; r < ROD_UNKNOWNS; ++r)
            if (r >= c)
                a[r][c] = column[r];
    }
}

/* The Gauss-Newton direction (displacement, rotation vector) of every segment. */
static inline void rod_direction(const rod_problem* rod, const rod_state* s,
                                 real u[][ROD_UNKNOWNS]) {
    const real zero = (real)(0.0f);
    rod_row row[PLAIT_VERTICES - 1];
    real a[ROD_UNKNOWNS][ROD_UNKNOWNS];
    rod_coupling b;
    rod_segment e = rod_segment_at(rod, s, 0);
    sym3 own = rod_joint_stiffness(rod, s, 0, e.bend);
    for (int k = 0; k < rod->step->segments; ++k) {
        const int tip = k == rod->step->segments - 1;
        rod_segment next = e;
        sym3 onward = {zero, zero, zero, zero, zero, zero};
        if (!tip) {
            next = rod_segment_at(rod, s, k + 1);
            onward = rod_joint_stiffness(rod, s, k + 1, next.bend);
        }
        const real inertia = rod_hold(rod, k + 1);
        rod_diagonal(a, &e, inertia, tip ? zero : next.stretch, own, onward);
        if (rod_in_contact(rod))
            rod_diagonal_contact(a, rod, s, k + 1);
        rod_descent(rod, s, k, &e, tip ? 0 : &next, row[k].z);
        if (k > 0)
            rod_eliminate(a, row[k].z, &b, &row[k - 1]);
        rod_factor(a);
        rod_back_substitute(a, row[k].z, 0);
        if (!tip) {
            b.stretch = next.stretch;
            b.pull = scale3(next.director, next.pull);
            b.turn = onward;
            b.round = rod_section_round(rod_section_of(rod, k + 1));
#pragma unroll
            for (int c = 0; c < ROD_UNKNOWNS; ++c) {
                rod_coupling_column(&b, c, row[k].next[c]);
                rod_back_substitute(a, row[k].next[c], c < 3 ? c : 0);
            }
        }
        e = next;
        own = onward;
    }
    const int last = rod->step->segments - 1;
#pragma unroll
    for (int r = 0; r < ROD_UNKNOWNS; ++r)
        u[last][r] = row[last].z[r];
    for (int k = last - 1; k >= 0; --k)
#pragma unroll
        for (int r = 0; r < ROD_UNKNOWNS; ++r) {
            u[k][r] = row[k].z[r];
#pragma unroll
            for (int c = 0; c < ROD_UNKNOWNS; ++c)
                u[k][r] -= row[k].next[c][r] * u[k + 1][c];
        }
}

/* exp(alpha w) q, w a rotation vector. */
static inline quat rod_turn(quat q, real x, real y, real z) {
    const real angle = 0.5f * sqrt(x * x + y * y + z * z);
    const mask small = angle < (real)(1e-4f);
    const real s = pick(small, (real)(0.5f), 0.5f * sin(angle) / pick(small, (real)(1.0f), angle));
    return unitq(mulq(quat_of(x * s, y * s, z * s, cos(angle)), q), q);
}

/* s = from moved by alpha along u. */
static inline void rod_move(const rod_problem* rod, rod_state* s, const rod_state* from,
                            real u[][ROD_UNKNOWNS], real alpha) {
    for (int k = 0; k < rod->step->segments; ++k) {
        s->x[k + 1] = axpy3(alpha, vec3_of(u[k][0], u[k][1], u[k][2]), from->x[k + 1]);
        s->q[k] = rod_turn(from->q[k], alpha * u[k][3], alpha * u[k][4], alpha * u[k][5]);
    }
}

/* One Newton step with backtracking per lane; lanes where the search fails take two iterations of
 * `cosserat` instead. */
static inline void rod_newton(const rod_problem* rod, rod_state* s) {
    real u[PLAIT_VERTICES - 1][ROD_UNKNOWNS];
    if (rod->contacts)
        contact_renew(rod->contacts, s->x);
    rod_state from = *s;
    const real limit = rod_potential(rod, s) * ROD_POTENTIAL_FACTOR + ROD_POTENTIAL_MIN;
    rod_direction(rod, s, u);
    real alpha = (real)(1.0f);
    rod_move(rod, s, &from, u, alpha);
    mask rose = !(rod_potential(rod, s) <= limit);
    for (int trial = 0; trial < ROD_HALVINGS && any_lane(rose); ++trial) {
        alpha = pick(rose, 0.5f * alpha, alpha);
        rod_move(rod, s, &from, u, alpha);
        rose = !(rod_potential(rod, s) <= limit);
    }
    if (any_lane(rose)) {
        cosserat_iterate(rod, &from, ROD_FALLBACK_ITERATIONS, 0);
        rod_pick(rod, rose, s, &from);
    }
}

static inline int rod_was_in_contact(const rod_problem* rod) {
    return rod->contacts && any_lane(rod->contacts->lanes);
}

/* Newton steps, and for strands that touch something one more: what touches has to settle too. */
static inline void rod_solve(const rod_problem* rod, rod_state* s, uint iterations) {
    rod_state untouched;
    for (uint k = 0; k < iterations || (k == iterations && rod_was_in_contact(rod)); ++k) {
        if (k == iterations)
            untouched = *s;
        rod_newton(rod, s);
    }
    if (rod_was_in_contact(rod))
        rod_pick(rod, !rod->contacts->lanes, s, &untouched);
}

__kernel void plait_articulated(BASELINE_ARGUMENTS) {
    HOLD_IDLE_LOCAL(item_count, lane_x)
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    rod_state s;
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    contact_loop contacts;
    contact_loop_begin(&contacts, &step, &params, collider, lane_plane, lane_x);
    rod_factors factors;
    const rod_problem rod = rod_problem_of(
        &step, y, lane_rest, contact_may_be(&params) ? &contacts.contacts : 0, &factors);
    rod_load(&rod, &params, &s, lane_q, lane_q_before);

    cosserat_iterate(&rod, &s, 1, 1);
    rod_solve(&rod, &s, params.iterations);

    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before, ROD_CONTACT_STRAIN);
}
