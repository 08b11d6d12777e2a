/* Our own `wind`: a boundary layer, still air below y = 0 and full wind from 0.2 m above it. Linear
 * drag, and neither the work-group memory nor the form of the built-in stage. */
#include "common/strand.clh"
#include "plait/params.h"

__kernel void plait_wind(const uint item_count, const plait_wind_params params,
                         __global const uint* vertex_count, __global const float4* position_prev,
                         __global float4* position, __local float4* shared_position) {
    const strand_item_t item = strand_item(params.vertex_stride);
    if (item.strand >= item_count || item.vertex >= vertex_count[item.strand])
        return;
    const float4 x = position[item.element];
    if (!is_free(x))
        return;
    const float3 air = clamp(x.y / 0.2f, 0.0f, 1.0f) * vload4(0, params.wind).xyz;
    const float3 v = (x.xyz - position_prev[item.element].xyz) / params.h;
    position[item.element] = x + (float4)(params.h * params.h * params.drag * (air - v), 0.0f);
}
