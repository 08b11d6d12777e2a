/* lane_wetness: the material of wet strands from that of dry ones.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, wetness_held, lane_dry; of lane_material the wetness that rows are scaled by.
 * Writes  lane_material of strands where that is another: mass times 1 + 0.6 w, joints times
 *         1 - 0.5 w, EA as the mass where it was chosen by weight; the rest as it is.
 * Source  ours; starting values, of which none was measured (constants.h).
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_step.clh"
#include "plait/constants.h"

#define LAST_ROW (PLAIT_VERTICES - 1)

static inline size_t at_row(lane_place place, size_t row, size_t component) {
    return lane_index(place, PLAIT_LANE_MATERIAL_COMPONENTS, row, component);
}

/* Of the lanes that have moved. */
static inline void put(__global real* lane_material, size_t at, mask moved, real value) {
    lane_material[at] = pick(moved, value, lane_material[at]);
}

__kernel PLAIT_WIDE void
plait_lane_wetness(const uint item_count, const plait_lane_wetness_params params,
                   __global const uint* lane_strand, __global const float* wetness_held,
                   __global const real* lane_dry, __global real* lane_material) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    real wetness;
    for (uint k = 0; k < PLAIT_LANES; ++k)
        LANE(wetness, k) = wetness_held[strands.at[k]];
    const mask moved = wetness != lane_material[at_row(place, LAST_ROW, PLAIT_LANE_WETNESS)];
    if (!any_lane(moved))
        return;
    const real heavier = 1.0f + PLAIT_WET_DENSITY * wetness;
    const real softer = 1.0f - PLAIT_WET_BEND * wetness;
    const mask weighed = lane_dry[at_row(place, LAST_ROW, PLAIT_LANE_WEIGHED)] != (real)(0.0f);
    const real stiffer = pick(weighed, heavier, (real)(1.0f));
    real before = (real)(1.0f); /* the root, too, has mass */
    for (size_t i = 0; i < PLAIT_VERTICES; ++i) {
        real dry[PLAIT_LANE_MATERIAL_COMPONENTS];
        for (size_t c = 0; c < PLAIT_LANE_MATERIAL_COMPONENTS; ++c)
            dry[c] = lane_dry[at_row(place, i, c)];
        const real length = dry[PLAIT_LANE_LENGTH];
        dry[PLAIT_LANE_MASS] *= pick(before > (real)(0.0f), heavier, (real)(1.0f));
        before = length;
        if (i < LAST_ROW) {
            dry[PLAIT_LANE_STRETCH] *= stiffer;
            const real least = PLAIT_LANE_LEAST_BEND * dry[PLAIT_LANE_STRETCH] * length * length;
            dry[PLAIT_LANE_BEND] = fmax(softer * dry[PLAIT_LANE_BEND], least);
            dry[PLAIT_LANE_TWIST] *= softer;
            dry[PLAIT_LANE_CROSS] *= softer;
        } else {
            dry[PLAIT_LANE_WETNESS] = wetness;
        }
        for (size_t c = 0; c < PLAIT_LANE_MATERIAL_COMPONENTS; ++c)
            put(lane_material, at_row(place, i, c), moved, dry[c]);
    }
}
