/* clamp: limit the displacement of a vertex per substep.
 *
 * Items   vertices.
 * Reads   position_prev.
 * Moves   position: displacements beyond C are scaled by C / |displacement|.
 * Source  TressFX 4.1, which scales by C^2 / |displacement|^2: the faster a vertex, the shorter its
 *         step.
 * Changed the scale; pinned vertices follow their root however far it goes.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/strand.clh"
#include "base/vec3.clh"
#include "plait/params.h"

__kernel void plait_clamp(const uint item_count, const plait_clamp_params params,
                          __global const float4* position_prev, __global float4* position) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const float4 x = position[item];
    const vec3 prev = unpack3(position_prev[item]);
    const vec3 displacement = sub3(unpack3(x), prev);
    const float distance_moved = length3(displacement);
    if (is_free(x) && distance_moved > params.max_displacement)
        position[item] =
            pack3(axpy3(params.max_displacement / distance_moved, displacement, prev), x.w);
}
