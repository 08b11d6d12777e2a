/* pair_find: of every segment the nearest others that it may meet before the next search.
 *
 * Items   vertices; of those that begin no segment there are none.
 * Reads   vertex_count, rest, position, position_prev, cell_end, cell_segment.
 * Writes  pair_segment, pair_offset: the diameter, or how far apart they are at rest if that is
 *         less; pair_dropped counts those that there is no room for.
 * Source  Ericson 2005, 5.1.9 (segments); the order, by distance and then by number, which makes
 *         the result that of any order in the cells: ours.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/pair.clh"

typedef struct {
    uint count;                       /* of all that are near */
    float distance[PLAIT_PAIR_COUNT]; /* m, squared; ascending */
    uint segment[PLAIT_PAIR_COUNT];
} pair_list;

static inline bool pair_before(float d, uint one, float e, uint other) {
    return d < e || (d == e && one < other);
}

/* Keeps the nearest. */
static inline void pair_insert(pair_list* list, float distance, uint other) {
    ++list->count;
    for (uint k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        if (!pair_before(distance, other, list->distance[k], list->segment[k]))
            continue;
        const float pushed = list->distance[k];
        const uint left = list->segment[k];
        list->distance[k] = distance;
        list->segment[k] = other;
        distance = pushed;
        other = left;
    }
}

typedef struct {
    const plait_pair_params* params;
    __global const float4* position;
    __global const float4* before;
    uint item;
    segment own;
    float length;     /* m, of it */
    float per_square; /* 1/m^2: 1 over its square */
} pair_search;

/* Segments of one strand meet where it has an arc between them. */
static inline bool pair_along(const pair_search* search, uint other, float length) {
    const uint stride = search->params->vertex_stride, item = search->item;
    if (item / stride != other / stride)
        return false;
    const float between = (float)(max(item, other) - min(item, other)) - 1.0f;
    return between * 0.5f * (length + search->length) < PLAIT_PAIR_ARC * search->params->diameter;
}

/* Of the middle of a segment from the own one, m, squared. */
static inline float pair_middle_distance(const pair_search* search, vec3 middle) {
    const vec3 out = sub3(middle, search->own.from);
    const float along = clamp(dot3(out, search->own.way) * search->per_square, 0.0f, 1.0f);
    const vec3 off = axpy3(-along, search->own.way, out);
    return dot3(off, off);
}

/* What is far is told by its middle, which most are. */
static inline void pair_look_at(const pair_search* search, uint other, pair_list* list) {
    const plait_pair_params* params = search->params;
    const segment its = segment_at(search->position, other);
    const float near = PLAIT_PAIR_NEAR * params->diameter, most = near + params->room;
    const float reach = most + params->voxel_edge;
    if (pair_middle_distance(search, axpy3(0.5f, its.way, its.from)) > reach * reach)
        return;
    const segment_foot foot = segment_nearest(search->own, its);
    const float squared = dot3(foot.apart, foot.apart);
    if (squared > most * most || other == search->item ||
        pair_along(search, other, length3(its.way)))
        return;
    if (squared > near * near) {
        const vec3 moves =
            sub3(segment_moves(search->position, search->before, search->item, foot.s),
                 segment_moves(search->position, search->before, other, foot.t));
        const float far = near + fmin(params->steps * length3(moves), params->room);
        if (squared > far * far)
            return;
    }
    pair_insert(list, squared, other);
}

/* Cells along one axis in which the middle of a segment may lie that is near. */
static inline int2 pair_cells(const plait_pair_params* params, float from, float way) {
    const float reach = PLAIT_PAIR_NEAR * params->diameter + params->room + params->voxel_edge;
    const int first = pair_cell_of(fmin(from, from + way) - reach, params->voxel_edge);
    const int last = pair_cell_of(fmax(from, from + way) + reach, params->voxel_edge);
    /* no cell twice */
    return (int2)(first, min(last, first + (int)params->edge_count - 1));
}

static inline void pair_look_around(const pair_search* search, __global const uint* cell_end,
                                    __global const uint* cell_segment, pair_list* list) {
    const plait_pair_params* params = search->params;
    const int2 xs = pair_cells(params, search->own.from.x, search->own.way.x);
    const int2 ys = pair_cells(params, search->own.from.y, search->own.way.y);
    const int2 zs = pair_cells(params, search->own.from.z, search->own.way.z);
    for (int z = zs.x; z <= zs.y; ++z)
        for (int y = ys.x; y <= ys.y; ++y) {
            const uint row = pair_cell(params, 0, y, z);
            for (int x = xs.x; x <= xs.y; ++x) {
                const uint cell = row + pair_wrapped(x, params->edge_count);
                const uint end = cell_end[cell];
                for (uint k = cell > 0u ? cell_end[cell - 1u] : 0u; k < end; ++k)
                    pair_look_at(search, cell_segment[k], list);
            }
        }
}

__kernel void plait_pair_find(const uint item_count, const plait_pair_params params,
                              __global const uint* vertex_count, __global const float4* rest,
                              __global const float4* position, __global const float4* position_prev,
                              __global const uint* cell_end, __global const uint* cell_segment,
                              __global uint* pair_segment, __global float* pair_offset,
                              __global uint* pair_dropped) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    pair_list list;
    list.count = 0;
    for (uint k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        list.distance[k] = MAXFLOAT;
        list.segment[k] = PLAIT_PAIR_NONE;
    }
    if (pair_has_segment(vertex_count, item, params.vertex_stride)) {
        const segment own = segment_at(position, item);
        const float length = length3(own.way);
        const float per_square = length > 0.0f ? 1.0f / (length * length) : 0.0f;
        const pair_search search = {&params, position, position_prev, item,
                                    own,     length,   per_square};
        pair_look_around(&search, cell_end, cell_segment, &list);
    }
    for (uint k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        const size_t at = (size_t)PLAIT_PAIR_COUNT * item + k;
        const uint other = list.segment[k];
        float offset = 0.0f;
        if (other != PLAIT_PAIR_NONE) {
            const segment_foot foot =
                segment_nearest(segment_at(rest, item), segment_at(rest, other));
            offset = fmin(params.diameter, length3(foot.apart));
        }
        pair_segment[at] = other;
        pair_offset[at] = offset;
    }
    if (list.count > PLAIT_PAIR_COUNT)
        atomic_add(pair_dropped, list.count - PLAIT_PAIR_COUNT);
}
