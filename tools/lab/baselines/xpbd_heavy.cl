/* Baseline: XPBD rods that turn as if a hundred times heavier, as games set them to get by with few
 * substeps: what bends then swings too slowly. */
#pragma OPENCL FP_CONTRACT OFF
#define XPBD_INERTIA 100.0f
#include "xpbd_rod.clh"
