/* Baseline: masses and springs by the midpoint method.
 *
 * Source    Ugurca 2015, eq. 2.17-2.19: the rates at half a step, taken from half an Euler step,
 *           over the whole step.
 * Standard  all of it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "mass_spring.clh"

static inline void spring_advance(const spring_strand* s, float h, vec3* x, vec3* v) {
    vec3 middle_x[PLAIT_VERTICES], middle_v[PLAIT_VERTICES], a[PLAIT_VERTICES];
    spring_accelerations(s, x, v, a);
    middle_x[0] = x[0];
    middle_v[0] = v[0];
    for (int i = 1; i <= s->step->segments; ++i) {
        middle_x[i] = axpy3((real)(0.5f * h), sub3(v[i], s->root_velocity), x[i]);
        middle_v[i] = axpy3((real)(0.5f * h), a[i], v[i]);
    }
    spring_accelerations(s, middle_x, middle_v, a);
    for (int i = 1; i <= s->step->segments; ++i) {
        x[i] = axpy3((real)(h), sub3(middle_v[i], s->root_velocity), x[i]);
        v[i] = axpy3((real)(h), a[i], v[i]);
    }
}

#include "mass_spring_kernels.clh"
