/* tangents: unit tangents towards the tip; and padding as copies of the tip, for display.
 *
 * Items   vertices, from those of strand_first on.
 * Reads   vertex_count, position.
 * Writes  tangent, w 0; position of padding only.
 * Source  TressFX 4.1: n(x_(i+1) - x_i), the last vertex has the one before it.
 * Changed a segment of no length takes the direction of the nearest one towards the root that has
 *         some, else of the nearest towards the tip, else +y: a tangent is always a unit vector.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/vec3.clh"
#include "plait/params.h"

static inline vec3 segment_direction(__global const float4* strand, uint segment) {
    return normalize3(sub3(unpack3(strand[segment + 1u]), unpack3(strand[segment])));
}

static inline vec3 tangent_at(__global const float4* strand, uint segment, uint count) {
    vec3 direction = segment_direction(strand, segment);
    if (nonzero3(direction))
        return direction;
    for (uint i = segment; i > 0u && !nonzero3(direction); --i)
        direction = segment_direction(strand, i - 1u);
    for (uint i = segment + 1u; i + 1u < count && !nonzero3(direction); ++i)
        direction = segment_direction(strand, i);
    return nonzero3(direction) ? direction : vec3_of(0.0f, 1.0f, 0.0f);
}

__kernel void plait_tangents(const uint item_count, const plait_tangents_params params,
                             __global const uint* vertex_count, __global float4* position,
                             __global float4* tangent) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    const uint strand = params.strand_first + item / params.vertex_stride;
    const uint vertex = item % params.vertex_stride;
    const uint count = vertex_count[strand];
    __global float4* row = position + (size_t)strand * params.vertex_stride;
    tangent[(size_t)strand * params.vertex_stride + vertex] =
        pack3(tangent_at(row, min(vertex, count - 2u), count), 0.0f);
    if (vertex >= count)
        row[vertex] = row[count - 1u];
}
