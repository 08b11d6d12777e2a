/* lane_accelerate: accelerations of vertices, strand after strand, to the lanes.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, acceleration, lane_pressure.
 * Writes  lane_acceleration: 0 past the tip, where it would pull at masses that are not there; the
 *         caller's counts as 0 where a component is not finite or beyond PLAIT_MOST_ACCELERATION.
 */
#include "base/lane_step.clh"
#include "push/acceleration.clh"

__kernel PLAIT_WIDE void
plait_lane_accelerate(const uint item_count, const plait_lane_tile_params params,
                      __global const uint* lane_strand, __global const uint* vertex_count,
                      __global const float4* acceleration, __global const real* lane_pressure,
                      __global real* lane_acceleration) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    real count;
    for (uint k = 0; k < PLAIT_LANES; ++k)
        LANE(count, k) = (float)vertex_count[strands.at[k]];
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    for (uint i = 0; i < PLAIT_VERTICES; ++i) {
        const vec3 own = gather3(acceleration, &strands, params.row_stride, i);
        const mask pulls = (real)((float)i) < count;
        vec3 push = allowed_acceleration(own);
        if (params.pressure)
            push = add3(push, load3(lane_pressure, place, i));
        store3(lane_acceleration, place, i, pick3(pulls, push, zero));
    }
}
