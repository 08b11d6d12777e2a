/* lane_unpack: lane state to positions in the world and their Verlet history, which display, the
 * inter-hair grid and interop read.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Writes  position, position_prev = position - h v; w 0 at the root, which is pinned, else 1.
 *         Strands lie in another order there than in lanes: to read w would be to wait for it.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_step.clh"

/* Past the cache, by whole lines of it: the lines of strands in another order would have to be
 * fetched first, which takes twice as long as all the rest. */
#define UNPACK_ROWS 4 /* float4s of a line */
#define STREAM(value, to) *(to) = value
#ifdef __has_builtin
#if __has_builtin(__builtin_nontemporal_store)
#undef STREAM
#define STREAM(value, to) __builtin_nontemporal_store(value, to)
#endif
#endif

typedef struct {
    vec3 now[UNPACK_ROWS], before[UNPACK_ROWS];
    float w[UNPACK_ROWS];
} unpack_rows;

static inline unpack_rows unpack_read(lane_place place, float h, vec3 root, uint first,
                                      __global const real* lane_x, __global const real* lane_v) {
    unpack_rows rows;
    for (uint j = 0; j < UNPACK_ROWS; ++j) {
        const uint i = min(first + j, (uint)PLAIT_VERTICES - 1);
        const vec3 x = i > 0 ? add3(root, load3(lane_x, place, i)) : root;
        const vec3 v = load3(lane_v, place, i);
        rows.now[j] = x;
        rows.before[j] = vec3_of(x.x - h * v.x, x.y - h * v.y, x.z - h * v.z);
        rows.w[j] = i == 0 ? 0.0f : 1.0f;
    }
    return rows;
}

static inline float4 unpack_of(vec3 x, float w, uint lane) {
    return (float4)(LANE(x.x, lane), LANE(x.y, lane), LANE(x.z, lane), w);
}

__kernel void plait_lane_unpack(const uint item_count, const plait_lane_layout_params params,
                                __global const uint* lane_strand, __global const uint* vertex_count,
                                __global const real* lane_x, __global const real* lane_v,
                                __global float4* position, __global float4* position_prev) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const uint lanes = lane_place_strands(place, item_count);
    size_t vertex[PLAIT_LANES];
    uint fewest = PLAIT_VERTICES;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        vertex[k] = (size_t)strands.at[k] * params.row_stride;
        fewest = min(fewest, vertex_count[strands.at[k]]);
    }
    const vec3 root = load3(lane_x, place, 0);
    for (uint first = 0; first < PLAIT_VERTICES; first += UNPACK_ROWS) {
        const unpack_rows rows = unpack_read(place, params.h, root, first, lane_x, lane_v);
        if (lanes == PLAIT_LANES && first + UNPACK_ROWS <= fewest) {
#pragma unroll
            for (uint k = 0; k < PLAIT_LANES; ++k) {
#pragma unroll
                for (uint j = 0; j < UNPACK_ROWS; ++j)
                    STREAM(unpack_of(rows.now[j], rows.w[j], k), position + vertex[k] + first + j);
#pragma unroll
                for (uint j = 0; j < UNPACK_ROWS; ++j)
                    STREAM(unpack_of(rows.before[j], rows.w[j], k),
                           position_prev + vertex[k] + first + j);
            }
            continue;
        }
        for (uint k = 0; k < lanes; ++k)
            for (uint j = 0; j < UNPACK_ROWS && first + j < vertex_count[strands.at[k]]; ++j) {
                position[vertex[k] + first + j] = unpack_of(rows.now[j], rows.w[j], k);
                position_prev[vertex[k] + first + j] = unpack_of(rows.before[j], rows.w[j], k);
            }
    }
}
