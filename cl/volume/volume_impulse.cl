/* volume_impulse: what the pressure and friction do to the hair at nodes.
 *
 * Items   voxels, whose centres are the nodes.
 * Reads   grid_density, grid_velocity, volume_link, volume_pressure.
 * Writes  volume_potential: the pressure over the density of hair, and that density, to be carried.
 *         volume_pull: the change of velocity by what the pressure has changed in the step and by
 *         friction, and the share of a vertex' own velocity that friction takes; the acceleration by
 *         all of the pressure, for the step to come.
 *
 * Along each axis the mean of both faces, of -(p_b - p_a)/(density e): with the mean density of both
 * sides at a face, the momenta that it gives to its two nodes add up to 0. Next to a collider it is
 * that of the face across, half of which would let hair sink onto the collider.
 *
 * Friction is viscous, the more so the more pressure pulls, of a share f(a) = r/(1 + r),
 * r = h viscosity (1 + PLAIT_VOLUME_FRICTION min(1, a/PLAIT_VOLUME_WEIGHT)). With a at the node hair
 * takes f of the node's velocity, with a at a face f/6 of the difference to that across it, as much as
 * keeps the momentum of both: what a node alone does would let waves of two voxels be, and a strand
 * that lies alone on others.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/vec3.clh"
#include "volume/volume.clh"

/* What the face between two nodes does to both, along its axis. */
typedef struct {
    float change; /* m/s */
    float push;   /* m/s^2 */
} face_pull;

static inline face_pull pull_of(const plait_volume_impulse_params* params, int low, int high,
                                float link, __global const float4* volume_link,
                                __global const float* volume_pressure) {
    const float p = volume_pressure[high] - volume_pressure[low];
    const float before = volume_link[high].w - volume_link[low].w;
    const float scale = -link / params->voxel_edge;
    const face_pull pull = {params->h * scale * (p - before), scale * p};
    return pull;
}

/* Share of a difference of velocities that friction takes in a step, where pressure pulls by a,
 * m/s^2. */
static inline float friction_of(const plait_volume_impulse_params* params, float a) {
    const float pressed = fmin(fabs(a) / PLAIT_VOLUME_WEIGHT, 1.0f);
    const float rate = params->h * params->viscosity * (1.0f + PLAIT_VOLUME_FRICTION * pressed);
    return rate / (1.0f + rate);
}

/* m/s: what the hair of `other` takes a node along by. */
static inline vec3 drag_of(const plait_volume_impulse_params* params, int node, int other,
                           float push, __global const float* grid_density,
                           __global const float4* grid_velocity) {
    const float there = grid_density[other], both = grid_density[node] + there;
    if (!(both > 0.0f))
        return zero3();
    const vec3 faster = sub3(unpack3(grid_velocity[other]), unpack3(grid_velocity[node]));
    return scale3(faster, friction_of(params, push) * there / both / 6.0f);
}

__kernel void plait_volume_impulse(const uint item_count, const plait_volume_impulse_params params,
                                   __global const float* grid_density,
                                   __global const float4* grid_velocity,
                                   __global const float4* volume_link,
                                   __global const float* volume_pressure,
                                   __global float* volume_potential, __global float4* volume_pull) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const volume_place place = volume_place_of(item, params.edge_count);
    const int node = (int)item;
    const float density = grid_density[node];
    const float potential = density > 0.0f ? volume_pressure[node] / density : 0.0f;
    vstore2((float2)(potential, density), (size_t)node, volume_potential);
    float next[3], previous[3], change[3], push[3];
    bool open = false;
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) {
        next[axis] = volume_has_next(&place, axis) ? volume_link_of(volume_link, node, axis) : 0.0f;
        const int before = node - volume_stride(place.count, axis);
        previous[axis] =
            volume_has_previous(&place, axis) ? volume_link_of(volume_link, before, axis) : 0.0f;
        open |= next[axis] > 0.0f || previous[axis] > 0.0f;
    }
    const vec3 velocity = unpack3(grid_velocity[node]);
    if (!open) {
        const float loose = friction_of(&params, 0.0f);
        volume_pull[2 * node] = pack3(scale3(velocity, loose), loose);
        volume_pull[2 * node + 1] = (float4)(0.0f);
        return;
    }
    vec3 drag = zero3();
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) {
        const int stride = volume_stride(place.count, axis);
        face_pull sum = {0.0f, 0.0f};
        int closed = 0;
        if (volume_has_next(&place, axis)) {
            sum = pull_of(&params, node, node + stride, next[axis], volume_link, volume_pressure);
            closed += next[axis] > 0.0f ? 0 : 1;
        }
        if (next[axis] > 0.0f)
            drag = add3(
                drag, drag_of(&params, node, node + stride, sum.push, grid_density, grid_velocity));
        if (volume_has_previous(&place, axis)) {
            const face_pull pull =
                pull_of(&params, node - stride, node, previous[axis], volume_link, volume_pressure);
            if (previous[axis] > 0.0f)
                drag = add3(drag, drag_of(&params, node, node - stride, pull.push, grid_density,
                                          grid_velocity));
            sum.change += pull.change;
            sum.push += pull.push;
            closed += previous[axis] > 0.0f ? 0 : 1;
        }
        const float share = closed > 0 ? 1.0f : 0.5f;
        change[axis] = share * sum.change;
        push[axis] = share * sum.push;
    }
    const vec3 pushed = vec3_of(push[0], push[1], push[2]);
    const float share = friction_of(&params, length3(pushed));
    const vec3 changed = add3(vec3_of(change[0], change[1], change[2]), drag);
    volume_pull[2 * node] = pack3(axpy3(share, velocity, changed), share);
    volume_pull[2 * node + 1] = pack3(pushed, 0.0f);
}
