/* volume_pressure: a sweep of projected Gauss-Seidel with overrelaxation over nodes of one colour.
 *
 * Items   voxels of one colour: item i is in column i modulo (n + 1)/2 of its colour's.
 * Reads   volume_link, volume_node.
 * Moves   volume_pressure.
 * Source  projected successive overrelaxation, Cryer 1971.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "volume/volume.clh"

__kernel void plait_volume_pressure(const uint item_count, const plait_volume_sweep_params params,
                                    __global const float4* volume_link,
                                    __global const float4* volume_node,
                                    __global float* volume_pressure) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const int n = (int)params.edge_count, half_row = (n + 1) / 2;
    const int row = (int)item / half_row; /* y n + z */
    const int x = 2 * ((int)item % half_row) + ((row / n + row % n + (int)params.colour) & 1);
    if (row >= n * n || x >= n)
        return;
    const int node = row * n + x;
    const float4 own = volume_node[node];
    if (!(own.z > 0.0f))
        return;
    /* hair is never in the outermost layer */
    const float4 link = volume_link[node];
    const float p = volume_pressure[node];
    const float flow = link.x * (p - volume_pressure[node + 1]) +
                       volume_link[node - 1].x * (p - volume_pressure[node - 1]) +
                       link.y * (p - volume_pressure[node + n * n]) +
                       volume_link[node - n * n].y * (p - volume_pressure[node - n * n]) +
                       link.z * (p - volume_pressure[node + n]) +
                       volume_link[node - n].z * (p - volume_pressure[node - n]);
    volume_pressure[node] = fmax(own.y, p - own.z * (own.x + flow));
}
