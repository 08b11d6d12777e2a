/* lane_unpack: lane state to what is shown: positions in the world and, where they are asked for,
 * tangents; and the Verlet history, which the inter-hair grid and interop read.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, lane_x, lane_v.
 * Writes  position, position_prev = position - h v; w 0 at the root, which is pinned, else 1.
 *         Output rows are in groom order: reading w back would be a scattered load.
 *         If params.shown: tangent, and padding of position and tangent, to the bit as `tangents`
 *         does, which then has nothing left to read positions again for.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "base/lane_rows.clh"
#include "base/lane_step.clh"

/* Where the strands in the lanes go. */
typedef struct {
    uint lanes, fewest; /* strands, and the fewest vertices of one */
    mask counts;
    size_t vertex[PLAIT_LANES];
} unpack_strands;

static inline unpack_strands unpack_strands_of(__global const uint* lane_strand,
                                               __global const uint* vertex_count, lane_place place,
                                               uint item_count, uint row_stride) {
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    unpack_strands to;
    to.lanes = lane_place_strands(place, item_count);
    to.counts = lane_counts(vertex_count, &strands);
    to.fewest = PLAIT_VERTICES;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        to.vertex[k] = (size_t)strands.at[k] * row_stride;
        to.fewest = min(to.fewest, (uint)LANE_OF_MASK(to.counts, k));
    }
    return to;
}

static inline float4 unpack_of(vec3 x, float w, uint lane) {
    return (float4)(LANE(x.x, lane), LANE(x.y, lane), LANE(x.z, lane), w);
}

/* Vertices `first` and on of all strands; `w` of all but the root, which has 0. */
static inline void unpack_write(const unpack_strands* to, uint first, const vec3* rows, float w,
                                __global float4* data) {
    if (to->lanes == PLAIT_LANES && first + LINE_ROWS <= to->fewest) {
#pragma unroll
        for (uint k = 0; k < PLAIT_LANES; ++k)
#pragma unroll
            for (uint j = 0; j < LINE_ROWS; ++j)
                STREAM(unpack_of(rows[j], first + j > 0 ? w : 0.0f, k),
                       data + to->vertex[k] + first + j);
        return;
    }
    for (uint k = 0; k < PLAIT_LANES; ++k) /* known here: else `vertex` lies in private memory */
#pragma unroll
        for (uint j = 0; j < LINE_ROWS; ++j)
            if (k < to->lanes && first + j < (uint)LANE_OF_MASK(to->counts, k))
                data[to->vertex[k] + first + j] = unpack_of(rows[j], first + j > 0 ? w : 0.0f, k);
}

static inline vec3 unpack_position(__global const real* lane_x, lane_place place, vec3 root,
                                   uint i) {
    return i > 0 ? add3(root, load3(lane_x, place, min(i, (uint)PLAIT_VERTICES - 1))) : root;
}

/* Of segment i, where it has a length and the strand goes so far, else `otherwise`. */
static inline vec3 unpack_direction(vec3 from, vec3 to, uint i, mask counts, vec3 otherwise) {
    const vec3 direction = normalize3(sub3(to, from));
    return pick3(nonzero3(direction) & ((mask)((int)i + 1) < counts), direction, otherwise);
}

/* Of the first segment that has a length, else +y: what segments of none before it take. */
static inline vec3 unpack_first_direction(const unpack_strands* to, __global const real* lane_x,
                                          lane_place place, vec3 root) {
    vec3 found = zero3(), from = root;
    for (uint i = 0; i + 1 < PLAIT_VERTICES; ++i) {
        const vec3 next = unpack_position(lane_x, place, root, i + 1);
        found = pick3(nonzero3(found), found, unpack_direction(from, next, i, to->counts, found));
        if (!any_lane(!nonzero3(found)))
            return found;
        from = next;
    }
    return pick3(nonzero3(found), found, spread3((float3)(0.0f, 1.0f, 0.0f)));
}

static inline void unpack_padding(const unpack_strands* to, uint row_stride,
                                  __global float4* data) {
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        __global float4* row = data + to->vertex[k];
        const uint count = (uint)LANE_OF_MASK(to->counts, k);
        for (uint i = count; k < to->lanes && i < row_stride; ++i)
            row[i] = row[count - 1u];
    }
}

__kernel PLAIT_WIDE void plait_lane_unpack(
    const uint item_count, const plait_lane_unpack_params params, __global const uint* lane_strand,
    __global const uint* vertex_count, __global const real* lane_x, __global const real* lane_v,
    __global float4* position, __global float4* position_prev, __global float4* tangent) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const unpack_strands to =
        unpack_strands_of(lane_strand, vertex_count, place, item_count, params.row_stride);
    const vec3 root = load3(lane_x, place, 0);
    vec3 direction = zero3();
    if (params.shown)
        direction = unpack_first_direction(&to, lane_x, place, root);
    for (uint first = 0; first < PLAIT_VERTICES; first += LINE_ROWS) {
        vec3 now[LINE_ROWS + 1], rows[LINE_ROWS];
#pragma unroll
        for (uint j = 0; j <= LINE_ROWS; ++j)
            now[j] = unpack_position(lane_x, place, root, first + j);
        unpack_write(&to, first, now, 1.0f, position);
#pragma unroll
        for (uint j = 0; j < LINE_ROWS; ++j) {
            const vec3 v = load3(lane_v, place, min(first + j, (uint)PLAIT_VERTICES - 1));
            rows[j] = vec3_of(now[j].x - params.h * v.x, now[j].y - params.h * v.y,
                              now[j].z - params.h * v.z);
        }
        unpack_write(&to, first, rows, 1.0f, position_prev);
        if (!params.shown)
            continue;
#pragma unroll
        for (uint j = 0; j < LINE_ROWS; ++j) {
            direction = unpack_direction(now[j], now[j + 1], first + j, to.counts, direction);
            rows[j] = direction;
        }
        unpack_write(&to, first, rows, 0.0f, tangent);
    }
    if (params.shown && to.fewest < params.row_stride) {
        unpack_padding(&to, params.row_stride, position);
        unpack_padding(&to, params.row_stride, tangent);
    }
}
