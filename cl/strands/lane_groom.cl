/* lane_groom: the spring that holds every vertex at its place in the groom, carried by its root.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, rest, pose, lane_material, lane_groom, lane_x, lane_v.
 * Moves   lane_spring: the spring is added to the pin that is there; 0 past the tip.
 *
 * The stiffness is that of the strand's material and `slider` times what stands against the
 * strand's own droop (docs/groom.md). It is no more than m rate and m pull/d, m the mass of the
 * vertex and d how far off it is: what is stiffer is not seen, and what is far is fetched and not
 * torn there, for a solve that is cut short jams where it should fold a strand at once.
 */
#include "base/lane_spring.clh"

__kernel PLAIT_WIDE void plait_lane_groom(
    const uint item_count, const plait_lane_groom_params params, __global const uint* lane_strand,
    __global const uint* vertex_count, __global const float4* rest, __global const float4* pose,
    __global const real* lane_material, __global const real* lane_groom,
    __global const real* lane_x, __global const real* lane_v, __global real* lane_spring) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const lane_pose root = lane_load_pose(rest, pose, &strands, params.row_stride);
    const vec3 rest_root = gather3(rest, &strands, params.row_stride, 0);
    const vec3 shift = sub3(load3(lane_x, place, 0), root.root);
    const quat none = quat_of((real)(0.0f), (real)(0.0f), (real)(0.0f), (real)(0.0f));
    storeq(lane_spring, place, 0, none);
    for (int i = 1; i < (int)params.vertex_stride; ++i) {
        const vec3 groomed = gather3(rest, &strands, params.row_stride, (uint)i);
        const vec3 target = rotate3(root.q, sub3(groomed, rest_root));
        const real distance =
            lane_spring_distance(target, shift, load3(lane_x, place, i),
                                 scale3(load3(lane_v, place, i), (real)(params.h)));
        const real mass = lane_material[lane_index(place, PLAIT_LANE_MATERIAL_COMPONENTS, (size_t)i,
                                                   PLAIT_LANE_MASS)];
        const real most =
            mass * fmin((real)(params.rate), params.pull / fmax(distance, (real)(1e-30f)));
        const real own = lane_groom[lane_index(place, PLAIT_LANE_GROOM_COMPONENTS, (size_t)i,
                                               PLAIT_LANE_GROOM_OWN)];
        const real droop = lane_groom[lane_index(place, PLAIT_LANE_GROOM_COMPONENTS, (size_t)i,
                                                 PLAIT_LANE_GROOM_DROOP)];
        const real stiff = fmin(own + params.slider * droop, most);
        const quat before = params.pins ? loadq(lane_spring, place, i) : none;
        storeq(lane_spring, place, i,
               pickq((mask)(i) < counts, lane_spring_with(before, target, stiff), none));
    }
}
