/* volume_impulse: what the pressure does to the hair at nodes.
 *
 * Items   voxels, whose centres are the nodes.
 * Reads   grid_density, grid_velocity, volume_link, volume_pressure.
 * Writes  volume_potential: the pressure over the density of hair, and that density, to be carried.
 *         volume_pull: the change of velocity by what the pressure has changed in the step, and the
 *         share `blend` of the hair's velocity; the acceleration by all of the pressure, for the
 *         step to come.
 *
 * Along each axis the mean of both faces, of -(p_b - p_a)/(density e): with the mean density of both
 * sides at a face, the momenta that it gives to its two nodes add up to 0. Next to a collider it is
 * that of the face across, half of which would let hair sink onto the collider.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/vec3.clh"
#include "common/volume.clh"

/* What the face between two nodes does to both. */
typedef struct {
    float change, push;
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
    const vec3 blended = scale3(unpack3(grid_velocity[node]), params.blend);
    if (!open) {
        volume_pull[2 * node] = pack3(blended, 0.0f);
        volume_pull[2 * node + 1] = (float4)(0.0f);
        return;
    }
#pragma unroll
    for (int axis = 0; axis < 3; ++axis) {
        const int stride = volume_stride(place.count, axis);
        face_pull sum = {0.0f, 0.0f};
        int closed = 0;
        if (volume_has_next(&place, axis)) {
            sum = pull_of(&params, node, node + stride, next[axis], volume_link, volume_pressure);
            closed += next[axis] > 0.0f ? 0 : 1;
        }
        if (volume_has_previous(&place, axis)) {
            const face_pull pull =
                pull_of(&params, node - stride, node, previous[axis], volume_link, volume_pressure);
            sum.change += pull.change;
            sum.push += pull.push;
            closed += previous[axis] > 0.0f ? 0 : 1;
        }
        const float share = closed > 0 ? 1.0f : 0.5f;
        change[axis] = share * sum.change;
        push[axis] = share * sum.push;
    }
    volume_pull[2 * node] = pack3(add3(vec3_of(change[0], change[1], change[2]), blended), 0.0f);
    volume_pull[2 * node + 1] = (float4)(push[0], push[1], push[2], 0.0f);
}
