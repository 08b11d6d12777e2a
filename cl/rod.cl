/* rod: one substep of the Cosserat rod by damped Gauss-Newton with a direct solve.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, lane_rest, capsule.
 * Moves   lane_x, lane_v, lane_q, and the steps before.
 * Source  the potential of common/rod.clh; unknowns per segment k are the displacement of vertex
 * k+1 and the rotation vector of q_k, so the Hessian is block tridiagonal, 6x6. Gauss-Newton plus
 *         the geometric term of tension, without which it diverges; backtracking on the potential;
 *         one iteration of `cosserat` before, two where the search fails.
 */
#pragma OPENCL FP_CONTRACT ON
#include "common/cosserat.clh"

#define ROD_UNKNOWNS 6
#define ROD_HALVINGS 4

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

/* What a joint's section adds to a block of the Hessian, rows and columns omega: side/4 R k R^T. */
static inline void rod_section_block(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], rod_section k,
                                     quat expected, float side) {
    const vec3 t = director(expected);
    const vec3 b = rotate3(expected, vec3_of((real)(0.0f), (real)(0.0f), (real)(1.0f)));
    const real along[3] = {t.x, t.y, t.z}, across[3] = {b.x, b.y, b.z};
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            a[3 + r][3 + c] +=
                0.25f * side * (k.twist * along[r] * along[c] + k.cross * across[r] * across[c]);
}

/* Lower triangle of the diagonal block of segment k; `next_*` belong to segment k+1, 0 at the tip.
 */
static inline void rod_diagonal(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], const rod_segment* e,
                                real inertia, real next_stretch, real next_bend) {
    const vec3 t = e->director;
    const real turn = e->pull * e->length + e->geometric;
    const real linear = inertia + e->stretch + next_stretch;
    const real angular = 0.25f * (e->bend + next_bend);
    for (int r = 0; r < ROD_UNKNOWNS; ++r)
        for (int c = 0; c <= r; ++c)
            a[r][c] = (real)(0.0f);
    a[0][0] = a[1][1] = a[2][2] = linear;
    /* rows omega, columns x: EA [t]x transposed */
    a[3][1] = e->pull * t.z;
    a[3][2] = -e->pull * t.y;
    a[4][0] = -e->pull * t.z;
    a[4][2] = e->pull * t.x;
    a[5][0] = e->pull * t.y;
    a[5][1] = -e->pull * t.x;
    /* I - t t^T without a difference: along t limp hair's twist is a millionth of `turn` */
    a[3][3] = angular + turn * (t.y * t.y + t.z * t.z);
    a[4][3] = -turn * t.y * t.x;
    a[4][4] = angular + turn * (t.x * t.x + t.z * t.z);
    a[5][3] = -turn * t.z * t.x;
    a[5][4] = -turn * t.z * t.y;
    a[5][5] = angular + turn * (t.x * t.x + t.y * t.y);
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

/* Block between segments k-1 (rows) and k (columns), e being segment k. */
static inline void rod_coupling(real b[ROD_UNKNOWNS][ROD_UNKNOWNS], const rod_segment* e) {
    const vec3 t = scale3(e->director, e->pull);
    for (int r = 0; r < ROD_UNKNOWNS; ++r)
        for (int c = 0; c < ROD_UNKNOWNS; ++c)
            b[r][c] = (real)(0.0f);
    b[0][0] = b[1][1] = b[2][2] = -e->stretch;
    b[3][3] = b[4][4] = b[5][5] = -0.25f * e->bend;
    /* x_k against omega_k: -EA [t]x */
    b[0][4] = t.z;
    b[0][5] = -t.y;
    b[1][3] = -t.z;
    b[1][5] = t.x;
    b[2][3] = t.y;
    b[2][4] = -t.x;
}

/* a = L L^T in place, the inverse pivots on the diagonal; 0 where rounding took one, as the twist
 * of long limp strands': that unknown stays. */
static inline void rod_factor(real a[ROD_UNKNOWNS][ROD_UNKNOWNS]) {
    for (int c = 0; c < ROD_UNKNOWNS; ++c) {
        real pivot = a[c][c];
        for (int k = 0; k < c; ++k)
            pivot -= a[c][k] * a[c][k];
        a[c][c] = pick(pivot > (real)(1e-30f), rsqrt(fmax(pivot, (real)(1e-30f))), (real)(0.0f));
        for (int r = c + 1; r < ROD_UNKNOWNS; ++r) {
            real sum = a[r][c];
            for (int k = 0; k < c; ++k)
                sum -= a[r][k] * a[c][k];
            a[r][c] = sum * a[c][c];
        }
    }
}

/* v = (L L^T)^-1 v */
static inline void rod_back_substitute(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], real v[ROD_UNKNOWNS]) {
    for (int r = 0; r < ROD_UNKNOWNS; ++r) {
        for (int k = 0; k < r; ++k)
            v[r] -= a[r][k] * v[k];
        v[r] *= a[r][r];
    }
    for (int r = ROD_UNKNOWNS - 1; r >= 0; --r) {
        for (int k = r + 1; k < ROD_UNKNOWNS; ++k)
            v[r] -= a[k][r] * v[k];
        v[r] *= a[r][r];
    }
}

static inline void rod_add_section(const rod_problem* rod, const rod_state* s, int k,
                                   real a[ROD_UNKNOWNS][ROD_UNKNOWNS], float side) {
    const rod_section section = rod_section_of(rod, k);
    if (!rod_section_round(section))
        rod_section_block(a, section, rod_expected(rod, s, k), side);
}

/* Minus the gradient for segment k; `next` is segment k+1 or null at the tip. */
static inline void rod_descent(const rod_problem* rod, const rod_state* s, int k,
                               const rod_segment* e, const rod_segment* next,
                               real g[ROD_UNKNOWNS]) {
    const int i = k + 1;
    const real inertia = rod_material(rod, i, PLAIT_LANE_MASS) * rod->inertia;
    vec3 force = sub3(scale3(sub3(rod->y[i], s->x[i]), inertia), e->tension);
    vec3 torque = scale3(cross3(e->director, e->tension), e->length);
    const quat expected = rod_expected(rod, s, k);
    torque = add3(torque, rod_joint_moment(rod, s, k, expected, e->bend));
    if (next) {
        const quat onward = rod_expected(rod, s, k + 1);
        force = add3(force, next->tension);
        torque = sub3(torque, rod_joint_moment(rod, s, k + 1, onward, next->bend));
    }
    if (rod_touches(rod))
        force = add3(force, contact_term_at(rod->contacts, i, s->x[i]).force);
    g[0] = force.x;
    g[1] = force.y;
    g[2] = force.z;
    g[3] = torque.x;
    g[4] = torque.y;
    g[5] = torque.z;
}

/* What elimination keeps of a segment: u_k = z - x_next u_(k+1). */
typedef struct {
    real z[ROD_UNKNOWNS];
    real next[ROD_UNKNOWNS][ROD_UNKNOWNS];
} rod_row;

/* Eliminate row k-1 from row k: a -= B^T X, g -= B^T z. */
static inline void rod_eliminate(real a[ROD_UNKNOWNS][ROD_UNKNOWNS], real g[ROD_UNKNOWNS],
                                 real b[ROD_UNKNOWNS][ROD_UNKNOWNS], const rod_row* before) {
    for (int r = 0; r < ROD_UNKNOWNS; ++r)
        for (int k = 0; k < ROD_UNKNOWNS; ++k) {
            g[r] -= b[k][r] * before->z[k];
            for (int c = 0; c <= r; ++c)
                a[r][c] -= b[k][r] * before->next[k][c];
        }
}

/* The Gauss-Newton direction (displacement, rotation vector) of every segment. */
static inline void rod_direction(const rod_problem* rod, const rod_state* s,
                                 real u[][ROD_UNKNOWNS]) {
    rod_row row[PLAIT_VERTICES - 1];
    real a[ROD_UNKNOWNS][ROD_UNKNOWNS], b[ROD_UNKNOWNS][ROD_UNKNOWNS];
    rod_segment e = rod_segment_at(rod, s, 0);
    for (int k = 0; k < rod->step->segments; ++k) {
        const int tip = k == rod->step->segments - 1;
        const rod_segment next = tip ? e : rod_segment_at(rod, s, k + 1);
        const real inertia = rod_material(rod, k + 1, PLAIT_LANE_MASS) * rod->inertia;
        rod_diagonal(a, &e, inertia, tip ? (real)(0.0f) : next.stretch,
                     tip ? (real)(0.0f) : next.bend);
        rod_add_section(rod, s, k, a, 1.0f);
        if (!tip)
            rod_add_section(rod, s, k + 1, a, 1.0f);
        if (rod_touches(rod))
            rod_diagonal_contact(a, rod, s, k + 1);
        rod_descent(rod, s, k, &e, tip ? 0 : &next, row[k].z);
        if (k > 0)
            rod_eliminate(a, row[k].z, b, &row[k - 1]);
        rod_factor(a);
        rod_back_substitute(a, row[k].z);
        if (!tip) {
            rod_coupling(b, &next);
            rod_add_section(rod, s, k + 1, b, -1.0f);
            for (int c = 0; c < ROD_UNKNOWNS; ++c) {
                real column[ROD_UNKNOWNS];
                for (int r = 0; r < ROD_UNKNOWNS; ++r)
                    column[r] = b[r][c];
                rod_back_substitute(a, column);
                for (int r = 0; r < ROD_UNKNOWNS; ++r)
                    row[k].next[r][c] = column[r];
            }
        }
        e = next;
    }
    for (int k = rod->step->segments - 1; k >= 0; --k)
        for (int r = 0; r < ROD_UNKNOWNS; ++r) {
            u[k][r] = row[k].z[r];
            if (k < rod->step->segments - 1)
                for (int c = 0; c < ROD_UNKNOWNS; ++c)
                    u[k][r] -= row[k].next[r][c] * u[k + 1][c];
        }
}

/* exp(alpha w) q, w a rotation vector. */
static inline quat rod_turn(quat q, real x, real y, real z) {
    const real angle = 0.5f * sqrt(x * x + y * y + z * z);
    const mask small = angle < (real)(1e-4f);
    const real s = pick(small, (real)(0.5f), 0.5f * sin(angle) / pick(small, (real)(1.0f), angle));
    return normalizeq(mulq(quat_of(x * s, y * s, z * s, cos(angle)), q), q);
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
    const real limit = rod_potential(rod, s) * 1.000001f + 1e-20f;
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
        cosserat_iterate(rod, &from, 2, 0);
        rod_pick(rod, rose, s, &from);
    }
}

static inline int rod_touched(const rod_problem* rod) {
    return rod->contacts && any_lane(rod->contacts->lanes);
}

/* Newton steps, and for strands that touch something one more: what touches has to settle too. */
static inline void rod_solve(const rod_problem* rod, rod_state* s, uint iterations) {
    rod_state untouched;
    for (uint k = 0; k < iterations || (k == iterations && rod_touched(rod)); ++k) {
        if (k == iterations)
            untouched = *s;
        rod_newton(rod, s);
    }
    if (rod_touched(rod))
        rod_pick(rod, !rod->contacts->lanes, s, &untouched);
}

__kernel void plait_rod(const uint item_count, const plait_lane_params params,
                        __global const uint* lane_strand, __global const float4* rest,
                        __global const float4* pose, __global const real* lane_material,
                        __global const real* lane_rest, __global const float4* capsule,
                        __global const real* lane_acceleration, __global real* lane_x,
                        __global real* lane_v, __global real* lane_q, __global real* lane_q_before,
                        __global real* lane_x_before, __global real* lane_v_before) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    rod_state s;
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    lane_contacts contacts;
    contact_begin(&contacts, &step, &params, capsule, lane_x);
    rod_factors factors;
    const rod_problem rod =
        rod_problem_of(&step, y, lane_rest, params.collider_count > 0 ? &contacts : 0, &factors);
    rod_load(&rod, &params, &s, lane_q, lane_q_before);

    cosserat_iterate(&rod, &s, 1, 1);
    rod_solve(&rod, &s, params.iterations);

    rod_store(&rod, &params, state, &s, w, lane_q, lane_q_before, 0);
}
