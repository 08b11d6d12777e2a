/* Baseline: position based dynamics of a limp strand, the stage `chain`.
 *
 * Source    Mueller et al. 2007: predict, `iterations` Gauss-Seidel sweeps over the distance
 *           constraints, root to tip, by inverse mass; velocity from the displacement. With one
 *           sweep and many substeps it is XPBD without compliance (Macklin et al. 2019).
 * Standard  all of it. No bending: that of PBD has no modulus; xpbd.cl has.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"
#include "collide.clh"

static inline void pbd_sweep(const lane_step* step, vec3* x) {
    real w0 = (real)(0.0f); /* the root is pinned */
    for (int i = 0; i < step->segments; ++i) {
        const real rest = lane_material_at(step, i, PLAIT_LANE_LENGTH);
        const real w1 = 1.0f / lane_material_at(step, i + 1, PLAIT_LANE_MASS);
        const vec3 edge = sub3(x[i + 1], x[i]);
        const real square = dot3(edge, edge);
        const mask good = (square > (real)(1e-30f)) & (rest > (real)(0.0f));
        const real inverse = rsqrt(pick(good, square, (real)(1.0f)));
        const real s = pick(good, (1.0f - rest * inverse) / (w0 + w1), (real)(0.0f));
        x[i] = axpy3(s * w0, edge, x[i]);
        x[i + 1] = axpy3(-s * w1, edge, x[i + 1]);
        w0 = w1;
    }
}

__kernel void plait_chain(const uint item_count, const plait_lane_params params,
                          __global const uint* lane_strand, __global const float4* rest,
                          __global const float4* pose, __global const real* lane_material,
                          __global const float4* collider, __global const real* lane_acceleration,
                          __global const real* lane_pin, __global const real* lane_plane,
                          __global real* lane_x, __global real* lane_v,
                          __global real* lane_x_before, __global real* lane_v_before) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, 0 /* no pins */))
        return;
    const lane_buffers state = {lane_x, lane_v, lane_x_before, lane_v_before};
    vec3 x[PLAIT_VERTICES], y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    for (int i = 0; i <= step.segments; ++i)
        x[i] = y[i];

    for (uint k = 0; k < params.iterations; ++k) {
        pbd_sweep(&step, x);
        for (int i = 1; i <= step.segments; ++i)
            x[i] = baseline_collide(&step, &params, collider, lane_x, i, x[i]);
    }

    lane_velocities(&step, x, y, w);
    store3(lane_x, step.place, 0, step.pose.root);
    for (int i = 1; i <= step.segments; ++i)
        lane_store(&step, state, i, x[i], w[i]);
}
