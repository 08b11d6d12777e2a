/* attach: long-range attachment; no vertex is farther from its root than its arc length allows.
 *
 * Items   strands.
 * Reads   rest_length, vertex_count.
 * Moves   position: free vertices beyond reach * (arc length from the root) are drawn back onto
 *         that sphere around the root.
 * Source  Kim, Chentanez & Mueller-Fischer 2012.
 * Changed one attachment, the root, along the strand instead of along geodesics of a mesh.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/strand.clh"
#include "base/vec3.clh"
#include "plait/params.h"

__kernel void plait_attach(const uint item_count, const plait_attach_params params,
                           __global const float* rest_length, __global const uint* vertex_count,
                           __global float4* position) {
    const uint strand = get_global_id(0);
    if (strand >= item_count)
        return;
    const size_t first = (size_t)strand * params.vertex_stride;
    const vec3 root = unpack3(position[first]);
    float arc = 0.0f;
    for (uint i = 1u; i < vertex_count[strand]; ++i) {
        arc += rest_length[first + i - 1u];
        const float4 x = position[first + i];
        const vec3 offset = sub3(unpack3(x), root);
        const float reach = params.reach * arc, distance_to_root = length3(offset);
        if (is_free(x) && distance_to_root > reach)
            position[first + i] = pack3(axpy3(reach / distance_to_root, offset, root), x.w);
    }
}
