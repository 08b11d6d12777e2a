/* Baseline: XPBD rods with the inertia their mass has. */
#pragma OPENCL FP_CONTRACT OFF
#define XPBD_INERTIA 1.0f
#include "xpbd_rod.clh"
