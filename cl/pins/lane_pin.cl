/* lane_pin: pins of vertices, strand after strand, to the lanes, where their targets are at the end
 * of a substep and as stiff as the strand can take.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, rest, pose, lane_material, pin_from, pin_to, lane_x, lane_v.
 * Writes  lane_pin: 0 at the root, where nothing pins, and past the tip.
 *
 * A stiffness is no more than max(hold M/l, rate m), M the strand's mass, l the segment before the
 * vertex and m its mass: all of the strand pulls the vertex off by a segment with `hold`, and
 * float32 has the digits for it. Nor than pull M/d, d how far off the vertex is: what is far is
 * fetched and not torn there, for a solve that is cut short jams where it should fold a strand at
 * once.
 */
#include "base/lane_spring.clh"
#include "pins/pin.clh"

/* Row `row` of pins, gathered into lanes: targets, and signed stiffness. */
static inline quat lane_pin_gather(__global const float4* pin_from, __global const float4* pin_to,
                                   const lane_strands* strands, uint row, uint row_stride,
                                   float share) {
    quat pin;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const size_t at = (size_t)strands->at[k] * row_stride + row;
        const float4 element = pin_between(pin_from[at], pin_to[at], share);
        LANE(pin.x, k) = element.x;
        LANE(pin.y, k) = element.y;
        LANE(pin.z, k) = element.z;
        LANE(pin.w, k) = element.w;
    }
    return pin;
}

static inline real lane_pin_material(__global const real* material, lane_place place, uint row,
                                     uint component) {
    return material[lane_index(place, PLAIT_LANE_MATERIAL_COMPONENTS, row, component)];
}

__kernel PLAIT_WIDE void plait_lane_pin(const uint item_count, const plait_lane_pin_params params,
                                        __global const uint* lane_strand,
                                        __global const uint* vertex_count,
                                        __global const float4* rest, __global const float4* pose,
                                        __global const real* lane_material,
                                        __global const float4* pin_from,
                                        __global const float4* pin_to, __global const real* lane_x,
                                        __global const real* lane_v, __global real* lane_pin) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const lane_pose root = lane_load_pose(rest, pose, &strands, params.row_stride);
    const vec3 rest_root = gather3(rest, &strands, params.row_stride, 0);
    const vec3 shift = sub3(load3(lane_x, place, 0), root.root);
    const quat none = quat_of((real)(0.0f), (real)(0.0f), (real)(0.0f), (real)(0.0f));
    real count, mass = (real)(0.0f);
    for (uint k = 0; k < PLAIT_LANES; ++k)
        LANE(count, k) = (float)vertex_count[strands.at[k]];
    for (uint i = 1; i < PLAIT_VERTICES; ++i)
        mass += pick((real)((float)i) < count,
                     lane_pin_material(lane_material, place, i, PLAIT_LANE_MASS), (real)(0.0f));
    storeq(lane_pin, place, 0, none);
    for (uint i = 1; i < PLAIT_VERTICES; ++i) {
        const quat pin =
            lane_pin_gather(pin_from, pin_to, &strands, i, params.row_stride, params.share);
        const mask there = ((real)((float)i) < count) & (pin.w != (real)(0.0f));
        if (!any_lane(there)) {
            storeq(lane_pin, place, i, none);
            continue;
        }
        const vec3 target = vec3_of(pin.x, pin.y, pin.z);
        const vec3 carried = rotate3(root.q, sub3(target, rest_root));
        const real length = lane_pin_material(lane_material, place, i - 1, PLAIT_LANE_LENGTH);
        const vec3 at = pick3(pin.w < (real)(0.0f), carried, sub3(target, root.root));
        const real distance = lane_spring_distance(
            at, shift, load3(lane_x, place, i), scale3(load3(lane_v, place, i), (real)(params.h)));
        const real own = lane_pin_material(lane_material, place, i, PLAIT_LANE_MASS);
        const real most =
            fmax(params.hold * mass / pick(there, length, (real)(1.0f)), params.rate * own);
        const real strongest = params.pull * mass / fmax(distance, (real)(1e-30f));
        const quat held = quat_of(at.x, at.y, at.z, fmin(fabs(pin.w), fmin(most, strongest)));
        storeq(lane_pin, place, i, pickq(there, held, none));
    }
}
