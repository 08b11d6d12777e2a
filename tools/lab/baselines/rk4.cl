/* Baseline: masses and springs by the classical Runge-Kutta method of order four.
 *
 * Source    Kutta 1901. Ugurca 2015 gives it as eq. 2.20-2.22, of which 2.21 and 2.22 are
 * misprinted. Standard  all of it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "mass_spring.clh"

static inline void spring_advance(const spring_strand* s, float h, vec3* x, vec3* v) {
    vec3 stage_x[PLAIT_VERTICES], stage_v[PLAIT_VERTICES], a[PLAIT_VERTICES];
    vec3 next_x[PLAIT_VERTICES], next_v[PLAIT_VERTICES];
    for (int i = 0; i <= s->step->segments; ++i) {
        stage_x[i] = next_x[i] = x[i];
        stage_v[i] = next_v[i] = v[i];
    }
    for (int stage = 0; stage < 4; ++stage) {
        const float weight = h * (stage == 0 || stage == 3 ? 1.0f / 6.0f : 1.0f / 3.0f);
        const float reach = h * (stage < 2 ? 0.5f : 1.0f); /* where the next stage is evaluated */
        spring_accelerations(s, stage_x, stage_v, a);
        for (int i = 1; i <= s->step->segments; ++i) {
            const vec3 rate = sub3(stage_v[i], s->root_velocity);
            next_x[i] = axpy3((real)(weight), rate, next_x[i]);
            next_v[i] = axpy3((real)(weight), a[i], next_v[i]);
            stage_x[i] = axpy3((real)(reach), rate, x[i]);
            stage_v[i] = axpy3((real)(reach), a[i], v[i]);
        }
    }
    for (int i = 1; i <= s->step->segments; ++i) {
        x[i] = next_x[i];
        v[i] = next_v[i];
    }
}

#include "mass_spring_kernels.clh"
