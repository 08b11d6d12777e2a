/* grid_resolve: fixed-point sums to density and mean velocity.
 *
 * Items   voxels.
 * Reads   grid_sum.
 * Writes  grid_density; grid_velocity: mean along the grid's axes and, in w, the rms speed.
 * Source  Ugurca 2015, eq. 4.2: V = sum tent v / D. An empty voxel has velocity 0.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/sum.clh"
#include "base/vec3.clh"
#include "plait/params.h"

__kernel void plait_grid_resolve(const uint item_count, const plait_grid_params params,
                                 __global const uint* grid_sum, __global float* grid_density,
                                 __global float4* grid_velocity) {
    const uint voxel = get_global_id(0);
    if (voxel >= item_count)
        return;
    __global const uint* words = grid_sum + (size_t)voxel * PLAIT_SUM_STRIDE;
    const float density = convert_float(sum_read(words)) / PLAIT_SUM_DENSITY_SCALE;
    const vec3 sum = vec3_of(convert_float(sum_read(words + 2)), convert_float(sum_read(words + 4)),
                             convert_float(sum_read(words + 6)));
    const vec3 momentum = div3(sum, PLAIT_SUM_MOMENTUM_SCALE);
    const float energy = convert_float(sum_read(words + 8)) / PLAIT_SUM_ENERGY_SCALE;
    grid_density[voxel] = density;
    grid_velocity[voxel] =
        density > 0.0f ? pack3(div3(momentum, density), sqrt(energy / density)) : (float4)(0.0f);
}
