/* volume_impulse: what the pressure does to the hair at nodes.
 *
 * Items   voxels, whose centres are the nodes.
 * Reads   volume_link, volume_before, volume_pressure.
 * Writes  volume_change: the change of velocity by what the pressure has changed in the step;
 *         volume_push: the acceleration by all of it, for the step to come.
 *
 * Along each axis the mean of both faces, of -(p_b - p_a)/(density e): with the mean density of both
 * sides at a face, the momenta that it gives to its two nodes add up to 0. Next to a collider it is
 * that of the face across, half of which would let hair sink onto the collider.
 * Source  ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/volume.clh"

/* Of a node with the next along an axis, or with the one before, as (change, push); 0 where that is
 * outside the grid. */
typedef struct {
    float change, push;
    bool open;
} face_pull;

static inline face_pull pull_of(const plait_volume_impulse_params* params, int low, int high,
                                float link, __global const float* volume_before,
                                __global const float* volume_pressure) {
    const float p = volume_pressure[high] - volume_pressure[low];
    const float before = params->carried ? volume_before[high] - volume_before[low] : 0.0f;
    const float scale = -link / params->voxel_edge;
    const face_pull pull = {params->h * scale * (p - before), scale * p, link > 0.0f};
    return pull;
}

__kernel void plait_volume_impulse(const uint item_count, const plait_volume_impulse_params params,
                                   __global const float4* volume_link,
                                   __global const float* volume_before,
                                   __global const float* volume_pressure,
                                   __global float4* volume_change, __global float4* volume_push) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const volume_place place = volume_place_of(item, params.edge_count);
    const int node = (int)item;
    float change[3], push[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int stride = volume_stride(place.count, axis);
        face_pull sum = {0.0f, 0.0f, false};
        int closed = 0;
        if (volume_has_next(&place, axis)) {
            const face_pull pull =
                pull_of(&params, node, node + stride, volume_link_of(volume_link, node, axis),
                        volume_before, volume_pressure);
            sum.change += pull.change;
            sum.push += pull.push;
            closed += pull.open ? 0 : 1;
        }
        if (volume_has_previous(&place, axis)) {
            const face_pull pull = pull_of(&params, node - stride, node,
                                           volume_link_of(volume_link, node - stride, axis),
                                           volume_before, volume_pressure);
            sum.change += pull.change;
            sum.push += pull.push;
            closed += pull.open ? 0 : 1;
        }
        const float share = closed > 0 ? 1.0f : 0.5f;
        change[axis] = share * sum.change;
        push[axis] = share * sum.push;
    }
    volume_change[node] = (float4)(change[0], change[1], change[2], 0.0f);
    volume_push[node] = (float4)(push[0], push[1], push[2], 0.0f);
}
