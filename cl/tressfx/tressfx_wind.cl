/* tressfx_wind: aerodynamic drag, or the published blend of four winds.
 *
 * Items   strands, V work-items of one work-group each.
 * Reads   vertex_count, position_prev.
 * Moves   position.
 * Source  PLAIT_WIND_DRAG: a = k |u_n| u_n, u = wind - v, u_n its part across the hair, k the drag
 *         coefficient over mass and length; the usual drag on a thin cylinder.
 *         PLAIT_WIND_PUBLISHED: TressFX 4.1: W blends four winds by a = (strand mod 20)/20,
 *         d = x_i - x_(i+1), x_i -= h^2 ((d x W) x d), i = 2 .. count-2.
 * Changed the published form, kept for parity, pushes against the wind and grows with the square of
 *         the unit of length; drag does neither and brakes in still air. Drag is applied
 *         implicitly: h k|u_n| / (1 + h k|u_n|) of u_n per step, which cannot overshoot the wind.
 *         Both read copies made before anything moves: the original reads a neighbour that the next
 *         work-item may have moved already.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/strand.clh"
#include "base/vec3.clh"
#include "plait/params.h"

static inline vec3 drag_displacement(const plait_tressfx_wind_params* params, vec3 tangent, vec3 x,
                                     vec3 prev) {
    const vec3 air = vec3_of(params->wind[0], params->wind[1], params->wind[2]);
    const vec3 u = sub3(air, div3(sub3(x, prev), params->h));
    const vec3 across = axpy3(-dot3(u, tangent), tangent, u);
    const float rate = params->h * params->drag * length3(across);
    return scale3(across, params->h * rate / (1.0f + rate));
}

static inline vec3 wind_corner(const plait_tressfx_wind_params* params, uint corner) {
    return unpack3(vload4(corner, params->corner));
}

static inline vec3 published_wind(const plait_tressfx_wind_params* params, uint strand) {
    const float a = (float)(strand % 20u) / 20.0f;
    const vec3 even = add3(wind_corner(params, 0u), wind_corner(params, 2u));
    const vec3 odd = add3(wind_corner(params, 1u), wind_corner(params, 3u));
    return axpy3(a, even, scale3(odd, 1.0f - a));
}

static inline vec3 published_displacement(const plait_tressfx_wind_params* params, uint strand,
                                          vec3 x, vec3 next) {
    const vec3 d = sub3(x, next);
    const vec3 back = cross3(cross3(d, published_wind(params, strand)), d);
    return scale3(back, -(params->h * params->h));
}

/* The segment towards the tip; at the last vertex the one before it. */
static inline vec3 wind_tangent(strand_item_t item, uint count, __local const float4* shared) {
    const uint last = item.vertex + 1u < count ? 0u : item.local_next;
    const uint from = item.local_index - last;
    return normalize3(sub3(unpack3(shared[from + item.local_next]), unpack3(shared[from])));
}

static inline vec3 wind_displacement(const plait_tressfx_wind_params* params, strand_item_t item,
                                     uint count, vec3 prev, __local const float4* shared) {
    const vec3 x = unpack3(shared[item.local_index]);
    if (params->form == PLAIT_WIND_DRAG)
        return drag_displacement(params, wind_tangent(item, count, shared), x, prev);
    const bool blown = item.vertex >= 2u && item.vertex + 1u < count;
    if (!blown)
        return zero3();
    const vec3 x_next = unpack3(shared[item.local_index + item.local_next]);
    return published_displacement(params, item.strand, x, x_next);
}

__kernel void plait_tressfx_wind(const uint item_count, const plait_tressfx_wind_params params,
                                 __global const uint* vertex_count,
                                 __global const float4* position_prev, __global float4* position,
                                 __local float4* shared_position) {
    const strand_item_t item = strand_item(params.vertex_stride);
    const uint count = item.strand < item_count ? vertex_count[item.strand] : 0u;
    if (item.vertex < count)
        shared_position[item.local_index] = position[item.element];
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item.vertex >= count || !is_free(shared_position[item.local_index]))
        return;
    const float4 x = shared_position[item.local_index];
    const vec3 moved = wind_displacement(&params, item, count, unpack3(position_prev[item.element]),
                                         shared_position);
    position[item.element] = pack3(add3(unpack3(x), moved), x.w);
}
