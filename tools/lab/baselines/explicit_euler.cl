/* Baseline: masses and springs by the explicit Euler method.
 *
 * Source    Ugurca 2015, eq. 2.14-2.15: x' = x + h v, v' = v + h a(x, v).
 * Standard  all of it. It feeds energy to whatever swings undamped, so its springs are given five
 *           times the lag of the others'; steps longer than that lag explode.
 */
#pragma OPENCL FP_CONTRACT OFF
#define SPRING_LAG 1e-4f /* s */
#include "mass_spring.clh"

static inline void spring_advance(const spring_strand* s, float h, vec3* x, vec3* v) {
    vec3 a[PLAIT_VERTICES];
    spring_accelerations(s, x, v, a);
    for (int i = 1; i <= s->step->segments; ++i) {
        x[i] = axpy3((real)(h), sub3(v[i], s->root_velocity), x[i]);
        v[i] = axpy3((real)(h), a[i], v[i]);
    }
}

#include "mass_spring_kernels.clh"
