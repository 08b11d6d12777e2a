/* lane_wind: drag of the air on every vertex, as what the solve knows: a spring,
 * which is drag taken implicitly, and an acceleration beside gravity.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, rest, pose, acceleration, wind_velocity, lane_material, lane_x,
 *         lane_v, with BDF2 lane_x_before, lane_v_before, with volume lane_pressure.
 * Writes  lane_push: the accelerations by drag, by the caller and by pressure; 0 past the tip.
 * Moves   lane_spring: the spring is added to the pin that is there.
 *
 * Drag f at the substep's begin, of the rate c, taken implicitly, m (f - c (v' - v)), v' = (x - X)/h'
 * the velocity at its end, is the acceleration f and a spring of stiffness m c/h' to X + h' v. c is
 * that across the strand or along it, whichever is greater.
 * BDF2 would let hair pass air that starts suddenly: its history of the velocity goes on as it was.
 * The acceleration (D - D_)/2h, D the change of velocity that backward Euler would make and D_ that
 * of the substep before, gives a free vertex the velocity of backward Euler; in steady air it is 0.
 * Of a jump of the wind a vertex feels its share, the field's w.
 * Source: drag see wind/lane_wind.clh; the rest is ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_spring.clh"
#include "push/acceleration.clh"
#include "wind/lane_wind.clh"

/* Of the strand at vertex i: from the vertex before to the one behind, or at the tip to the tip. */
static inline lane_direction direction_at(lane_place place, __global const real* lane_x, int i,
                                          mask counts) {
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    const vec3 own = load3(lane_x, place, i);
    const vec3 before = i > 1 ? load3(lane_x, place, i - 1) : zero;
    vec3 ahead = own;
    if (i + 1 < PLAIT_VERTICES)
        ahead = pick3((mask)(i + 1) < counts, load3(lane_x, place, i + 1), own);
    return lane_direction_of(sub3(ahead, before));
}

/* m of hair that the mass of vertex i is of. */
static inline real length_at(const lane_step* step, int i) {
    const real before = lane_material_at(step, i - 1, PLAIT_LANE_LENGTH);
    return 0.5f * (before + lane_material_at(step, i, PLAIT_LANE_LENGTH));
}

/* The lanes of a work-item in this stage, whose drag, rho d/2 in kg/m^2, is the strand's own. */
static inline lane_step step_of(const plait_lane_wind_params* params, lane_place place,
                                lane_pose pose, __global const real* material) {
    lane_step step;
    step.place = place;
    step.material = material;
    step.acceleration = step.pin = 0;
    step.pose = pose;
    step.bdf2 = params->bdf2 != 0;
    step.whole = params->h;
    step.h = params->h * (step.bdf2 ? 2.0f / 3.0f : 1.0f);
    step.segments = (int)params->vertex_stride - 1;
    step.drag = params->drag * lane_strand_scale(&step, PLAIT_LANE_DRAG);
    step.friction = (real)(0.0f);
    return step;
}

/* Asks for what comes next. */
static inline void fetch_row(const lane_step* step, lane_buffers state,
                             __global const real* lane_push, __global const real* lane_spring,
                             size_t row) {
    const lane_place place = step->place;
    lane_fetch(state.x, place, 3, row);
    lane_fetch(state.v, place, 3, row);
    if (step->bdf2) {
        lane_fetch(state.x_before, place, 3, row);
        lane_fetch(state.v_before, place, 3, row);
    }
    PLAIT_FETCH(step->material +
                lane_index(place, PLAIT_LANE_MATERIAL_COMPONENTS, row, PLAIT_LANE_LENGTH));
    PLAIT_FETCH(step->material +
                lane_index(place, PLAIT_LANE_MATERIAL_COMPONENTS, row, PLAIT_LANE_MASS));
    lane_fetch(lane_push, place, 3, row);
    lane_fetch(lane_spring, place, 4, row);
}

__kernel PLAIT_WIDE void plait_lane_wind(
    const uint item_count, const plait_lane_wind_params params, __global const uint* lane_strand,
    __global const uint* vertex_count, __global const float4* rest, __global const float4* pose,
    __global const float4* acceleration, __global const float4* wind_velocity,
    __global const real* lane_material, __global const real* lane_x, __global const real* lane_v,
    __global const real* lane_x_before, __global const real* lane_v_before,
    __global const real* lane_pressure, __global real* lane_push, __global real* lane_spring) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const mask counts = lane_counts(vertex_count, &strands);
    const lane_pose root = lane_load_pose(rest, pose, &strands, params.row_stride);
    lane_fetch_next(lane_strand, rest, pose, place, item_count, params.row_stride);
    const lane_step step = step_of(&params, place, root, lane_material);
    /* only read here */
    const lane_buffers state = {(__global real*)lane_x, (__global real*)lane_v,
                                (__global real*)lane_x_before, (__global real*)lane_v_before};
    const grid_frame grid = grid_at(params.q, params.t, params.voxel_edge, params.edge_count);
    const vec3 shift = lane_shift(&step, state), at_begin = load3(lane_x, place, 0);
    const vec3 jump =
        vec3_of((real)(params.jump[0]), (real)(params.jump[1]), (real)(params.jump[2]));
    const vec3 zero = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    const quat none = quat_of((real)(0.0f), (real)(0.0f), (real)(0.0f), (real)(0.0f));
    const real most = (real)(PLAIT_AIR_MOST_DRAG / step.h);
    store3(lane_push, place, 0, zero);
    storeq(lane_spring, place, 0, none);
    for (int i = 1; i <= step.segments; ++i) {
        fetch_row(&step, state, lane_push, lane_spring, (size_t)i + PLAIT_ROWS_AHEAD);
        const mask there = (mask)(i) < counts;
        const vec3 v = load3(lane_v, place, i);
        quat air = quat_of((real)(params.air[0]), (real)(params.air[1]), (real)(params.air[2]),
                           (real)(0.0f));
        if (params.field)
            air = addq(air,
                       lane_air_at(&grid, wind_velocity, add3(at_begin, load3(lane_x, place, i))));
        else
            air.w = (real)(1.0f);
        const vec3 wind = vec3_of(air.x, air.y, air.z), u = sub3(wind, v);
        const lane_direction along = direction_at(place, lane_x, i, counts);
        const real mass = lane_material_at(&step, i, PLAIT_LANE_MASS);
        const real share = step.drag * length_at(&step, i) / mass;
        const lane_drag drag = lane_drag_of(&params, u, along, share, most);
        vec3 push = drag.force;
        if (step.bdf2) {
            const vec3 u_before = sub3(axpy3(-air.w, jump, wind), load3(lane_v_before, place, i));
            const lane_drag before = lane_drag_of(&params, u_before, along, share, most);
            push = axpy3((real)(0.5f / params.h), lane_drag_gain(drag, before, params.h), push);
        }
        if (params.accelerates)
            push = add3(push, allowed_acceleration(
                                  gather3(acceleration, &strands, params.row_stride, (uint)i)));
        if (params.pressure)
            push = add3(push, load3(lane_pressure, place, i));
        store3(lane_push, place, i, pick3(there, push, zero));
        const vec3 target =
            axpy3((real)(step.h), v, add3(lane_history_position(&step, state, i), shift));
        const real stiff = mass * drag.rate * (1.0f / step.h);
        const quat spring = params.pins
                                ? lane_spring_with(loadq(lane_spring, place, i), target, stiff)
                                : quat_of(target.x, target.y, target.z, stiff);
        storeq(lane_spring, place, i, pickq(there, spring, none));
    }
}
