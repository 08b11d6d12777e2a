/* chain: one step of an inextensible chain without bending.
 *
 * Items: strands, over lanes. Reads pose, rest, material; reads and writes the lane state x, v.
 * Predict, K tridiagonal length solves (Han & Harada 2013), one exact follow-the-leader sweep with
 * the velocity correction of Mueller et al. 2012 applied to that sweep's displacement alone (ours).
 * K = 0 is Mueller's dynamic follow-the-leader.
 */
#pragma OPENCL FP_CONTRACT ON
#include "common/lane_step.clh"

#define CHAIN_CORRECTION 0.5f /* s_damping of Mueller et al. 2012 */

/* n(a), or `otherwise` where a vanishes. */
inline vec3 unit3(vec3 a, vec3 otherwise) {
    const real square = dot3(a, a);
    const mask good = square > (real)(1e-30f);
    const real s = rsqrt(pick(good, square, (real)(1.0f)));
    return vec3_of(pick(good, a.x * s, otherwise.x), pick(good, a.y * s, otherwise.y),
                   pick(good, a.z * s, otherwise.z));
}

/* Project x on linearised edge lengths: J M^-1 J^T lambda = C, C capped at one rest length. */
inline void chain_solve_lengths(const lane_step* step, vec3* x) {
    vec3 u[PLAIT_VERTICES];
    real upper[PLAIT_VERTICES], lambda[PLAIT_VERTICES];
    const vec3 down = vec3_of((real)(0.0f), (real)(-1.0f), (real)(0.0f));
    real w0 = (real)(0.0f); /* the root is pinned */
    for (int i = 0; i < step->segments; ++i) {
        const real rest = lane_material_at(step, i, PLAIT_LANE_LENGTH);
        const real w1 = 1.0f / lane_material_at(step, i + 1, PLAIT_LANE_MASS);
        const vec3 edge = sub3(x[i + 1], x[i]);
        u[i] = unit3(edge, down);
        real residual = fmin(dot3(edge, u[i]) - rest, rest);
        residual = pick(rest > (real)(0.0f), residual, (real)(0.0f)); /* past the tip */
        real diagonal = w0 + w1;
        if (i > 0) {
            const real lower = -dot3(u[i - 1], u[i]) * w0;
            diagonal -= lower * upper[i - 1];
            residual -= lower * lambda[i - 1];
        }
        const real next = i + 1 < step->segments
                              ? -dot3(u[i], unit3(sub3(x[i + 2], x[i + 1]), down)) * w1
                              : (real)(0.0f);
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
        x[i] = axpy3(1.0f / lane_material_at(step, i, PLAIT_LANE_MASS), pull, x[i]);
    }
}

/* Exact lengths, root to tip; d[i] is the displacement of vertex i. */
inline void chain_follow_leader(const lane_step* step, vec3* x, vec3* d) {
    const vec3 down = vec3_of((real)(0.0f), (real)(-1.0f), (real)(0.0f));
    for (int i = 0; i < step->segments; ++i) {
        const vec3 direction = unit3(sub3(x[i + 1], x[i]), down);
        const vec3 exact = axpy3(lane_material_at(step, i, PLAIT_LANE_LENGTH), direction, x[i]);
        d[i + 1] = sub3(exact, x[i + 1]);
        x[i + 1] = exact;
    }
}

__kernel void plait_chain(const uint item_count, const plait_lane_params params,
                          __global const float4* rest, __global const float4* pose,
                          __global const real* lane_material, __global real* lane_x,
                          __global real* lane_v, __global real* lane_x_before,
                          __global real* lane_v_before) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, rest, pose, lane_material))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    vec3 x[PLAIT_VERTICES], y[PLAIT_VERTICES], w[PLAIT_VERTICES], d[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    for (int i = 0; i <= step.segments; ++i)
        x[i] = y[i];

    for (uint k = 0; k < params.iterations; ++k)
        chain_solve_lengths(&step, x);
    chain_follow_leader(&step, x, d);

    store3(lane_x, step.place, 0, step.pose.root);
    for (int i = 1; i <= step.segments; ++i) {
        /* the sweep moved vertex i+1 as if pulled by i: i recoils */
        if (i < step.segments)
            w[i] = axpy3((real)(-CHAIN_CORRECTION / step.h), d[i + 1], w[i]);
        lane_finish(&step, state, i, x[i], y[i], w[i]);
    }
}
