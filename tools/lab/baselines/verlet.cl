/* Baseline: masses and springs by Verlet integration.
 *
 * Source    Verlet 1967; Ugurca 2015, eq. 2.23-2.25: x' = 2x - x_before + h^2 a, v = (x -
 * x_before)/h. Standard  all of it; v is kept in place of x_before, which is the same short of
 * rounding.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "mass_spring.clh"

static inline void spring_advance(const spring_strand* s, float h, vec3* x, vec3* v) {
    vec3 a[PLAIT_VERTICES];
    spring_accelerations(s, x, v, a);
    for (int i = 1; i <= s->step->segments; ++i) {
        v[i] = axpy3((real)(h), a[i], v[i]);
        x[i] = axpy3((real)(h), sub3(v[i], s->root_velocity), x[i]);
    }
}

#include "mass_spring_kernels.clh"
