/* contact_pair_find: of every segment the nearest others that it may meet before the next search.
 *
 * Items   vertices: of each that it begins no segment, and places in cell_segment: the segment there.
 * Reads   vertex_count, rest, cell_end, cell_segment, cell_line, cell_moves.
 * Writes  pair_segment, pair_offset: the diameter, or how far apart they are at rest if that is
 *         less; pair_dropped counts the segments that more are near than there is room for.
 * Source  Ericson 2005, 5.1.9 (segments); ours: the order, by distance and then by number, which makes
 *         the result that of any order in the cells; the way through the cells.
 *
 * Segments are looked at as they lie in cell_line, row of cells by row of cells: on CPUs as many at
 * once as a register holds, each lane another of them, on GPUs one by one. Work-items beside each other
 * have segments of one cell, and look at the same ones.
 */
#pragma OPENCL FP_CONTRACT OFF
#define PLAIT_LANES PLAIT_DEVICE_LANES
#include "strand_contact/pair.clh"

/* One place more than is kept tells whether a pair has no place. */
#define PAIR_PLACES (PLAIT_PAIR_COUNT + 1u)

typedef struct {
    float distance[PAIR_PLACES]; /* m, squared; ascending */
    uint segment[PAIR_PLACES];
    float within; /* m: a segment farther than that gets no place */
} pair_list;

static inline bool pair_before(float d, uint one, float e, uint other) {
    return d < e || (d == e && one < other);
}

/* Keeps the nearest, each once. */
static inline void pair_insert(pair_list* list, float distance, uint other) {
    const uint last = PAIR_PLACES - 1u;
    if (!pair_before(distance, other, list->distance[last], list->segment[last]))
        return;
    for (uint k = 0; k < last; ++k)
        if (list->segment[k] == other)
            return;
    for (uint k = 0; k < PAIR_PLACES; ++k) {
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

/* ---- segments as they lie in the cells ------------------------------------------------------- */

typedef struct {
    __global const uint* end;
    __global const uint* segment;
    __global const float* line;
    size_t stride; /* from one component of `line` to the next */
} pair_cells;

/* A real wherever it begins: vload() of PoCL is put together from parts. */
typedef struct {
    real value;
} __attribute__((packed)) pair_real;

/* Of segment k and, over lanes, of those after it. */
static inline real pair_read(const pair_cells* cells, uint component, uint k) {
    return ((__global const pair_real*)(cells->line + component * cells->stride + k))->value;
}

static inline vec3 pair_read3(const pair_cells* cells, uint component, uint k) {
    return vec3_of(pair_read(cells, component, k), pair_read(cells, component + 1u, k),
                   pair_read(cells, component + 2u, k));
}

/* 0, 1, ...: constants, because PoCL runs a loop that fills them once for every register of segments. */
#if PLAIT_LANES == 16
#define PAIR_LANE_NUMBERS ((mask)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
#elif PLAIT_LANES == 8
#define PAIR_LANE_NUMBERS ((mask)(0, 1, 2, 3, 4, 5, 6, 7))
#elif PLAIT_LANES == 4
#define PAIR_LANE_NUMBERS ((mask)(0, 1, 2, 3))
#else
#define PAIR_LANE_NUMBERS ((mask)(0))
#endif

/* The lanes of a mask as bits. */
static inline uint pair_bits(mask found) {
    return (uint)or_lanes(found & ((mask)(1) << PAIR_LANE_NUMBERS));
}

/* ---- what one is looked for by ---------------------------------------------------------------- */

typedef struct {
    const plait_pair_params* params;
    uint item, root; /* its first vertex, and that of its strand */
    float length;    /* m, of it */
    segment own;
    vec3 middle, half_edges; /* m, of the box around it */
    vec3 moves;              /* m: what its middle moves by in a substep */
    vec3 change;             /* m: what its second vertex moves by less its first */
    float near, most;        /* m: so near it is a pair however slow, and so near however fast */
    float rounding;          /* m: by which gaps between boxes may be off */
} pair_search;

/* Are the boxes around segments k and after it within `limit`, m, of that around the own, along each axis? */
static inline mask pair_boxes_near(const pair_search* search, const pair_cells* cells, uint k,
                                   real limit) {
    const vec3 off = sub3(pair_read3(cells, PLAIT_PAIR_MIDDLE, k), search->middle);
    const vec3 its = pair_read3(cells, PLAIT_PAIR_HALF, k);
    return (fabs(off.x) <= its.x + (search->half_edges.x + limit)) &
           (fabs(off.y) <= its.y + (search->half_edges.y + limit)) &
           (fabs(off.z) <= its.z + (search->half_edges.z + limit));
}

/* Segments of one strand meet where it has an arc between them; a segment does not meet itself. */
static inline bool pair_along(const pair_search* search, uint other, float square) {
    if (other - search->root >= search->params->vertex_stride) /* of another: round about 0, too */
        return false;
    const uint apart = max(search->item, other) - min(search->item, other);
    const float lengths = search->length + sqrt(square), between = (float)apart - 1.0f;
    return between * 0.5f * lengths < PLAIT_PAIR_ARC * search->params->diameter;
}

/* How near a pair may be whose points move by so much from each other in a substep. */
static inline real pair_reach(const pair_search* search, real moves) {
    const plait_pair_params* params = search->params;
    return (real)(search->near) + fmin((real)(params->steps) * moves, (real)(params->room));
}

/* By how much the nearest points of two segments move from each other. */
static inline real pair_apart(const pair_search* search, const pair_cells* cells, uint k,
                              vec3 moves, segment_foot foot) {
    const real to_middle = (real)(0.5f);
    const vec3 own = axpy3(foot.s - to_middle, search->change, search->moves);
    const vec3 change = pair_read3(cells, PLAIT_PAIR_CHANGE, k);
    return length3(sub3(own, axpy3(foot.t - to_middle, change, moves)));
}

/* m: a segment farther than that is no pair, or gets no place. */
static inline float pair_limit(const pair_search* search, const pair_list* list) {
    return fmin(search->most, list->within + search->rounding);
}

/* Looks at segments k and after it, of which there are no more than `end`: first at their boxes, then at
 * themselves. */
static inline void pair_look_at(const pair_search* search, const pair_cells* cells, uint k,
                                uint end, pair_list* list) {
    mask found = (PAIR_LANE_NUMBERS < (mask)((int)(end - k))) &
                 pair_boxes_near(search, cells, k, (real)(pair_limit(search, list)));
    if (!any_lane(found))
        return;
    const segment its = {pair_read3(cells, PLAIT_PAIR_FROM, k),
                         pair_read3(cells, PLAIT_PAIR_WAY, k)};
    const segment_foot foot = segment_nearest(search->own, its);
    const real squared = dot3(foot.apart, foot.apart), square = dot3(its.way, its.way);
    const vec3 moves = pair_read3(cells, PLAIT_PAIR_MOVES, k);
    const real reach = pair_reach(search, pair_apart(search, cells, k, moves, foot));
    found &= (squared <= reach * reach) & (squared <= (real)(list->distance[PAIR_PLACES - 1u]));
    for (uint bits = pair_bits(found); bits != 0u; bits &= bits - 1u) {
        const uint lane = 31u - clz(bits & (0u - bits)); /* the lowest */
        const uint other = cells->segment[k + lane];
        if (!pair_along(search, other, LANE(square, lane)))
            pair_insert(list, LANE(squared, lane), other);
    }
    list->within = sqrt(list->distance[PAIR_PLACES - 1u]);
}

/* ---- the way through the cells ---------------------------------------------------------------- */

/* The part of the own segment, from 0 to 1, that comes near some cells. */
typedef struct {
    real first, last;
} pair_part;

/* Cells along an axis. */
typedef struct {
    real first, last; /* whole numbers */
} pair_run;

/* The own segment along an axis, and how cells lie there. */
typedef struct {
    float from, way;      /* m */
    float edge, per_edge; /* m, 1/m */
} pair_axis;

/* Which part of it comes within reach, m, of the cells of these numbers. */
static inline pair_part pair_near_cells(pair_part part, const pair_axis* axis, real number,
                                        real reach) {
    if (fabs(axis->way) <= FLT_MIN)
        return part;
    const real per_way = (real)(1.0f / axis->way), from = (real)(axis->from);
    const real low = number * (real)(axis->edge) - from;
    const real one = (low - reach) * per_way, other = (low + (real)(axis->edge) + reach) * per_way;
    /* not written into the argument: Mesa's compiler would write into the caller's */
    const pair_part near = {fmax(part.first, fmin(one, other)), fmin(part.last, fmax(one, other))};
    return near;
}

/* Cells within reach of that part, none twice. */
static inline pair_run pair_cells_near(pair_part part, const pair_axis* axis, real reach,
                                       uint edge_count) {
    const real from = (real)(axis->from), way = (real)(axis->way);
    const real one = from + part.first * way, other = from + part.last * way;
    const real per_edge = (real)(axis->per_edge);
    pair_run run;
    run.first = floor((fmin(one, other) - reach) * per_edge);
    run.last = floor((fmax(one, other) + reach) * per_edge);
    run.last = fmin(run.last, run.first + (real)((float)edge_count - 1.0f));
    return run;
}

/* m^2: what is left of the square of a reach beside the gap between that part and these cells. */
static inline real pair_left(real square, pair_part part, const pair_axis* axis, real number) {
    const real from = (real)(axis->from), way = (real)(axis->way), edge = (real)(axis->edge);
    const real one = from + part.first * way, other = from + part.last * way;
    const real low = number * edge;
    const real gap =
        fmax(fmax(low - fmax(one, other), fmin(one, other) - low - edge), (real)(0.0f));
    return fmax(square - gap * gap, (real)(0.0f));
}

/* first, first + 1, ... */
static inline real pair_numbers(float first) {
    return (real)(first) + LANE_REAL(PAIR_LANE_NUMBERS);
}

/* m: where to look for middles of segments of which a point is that near. */
static inline float pair_far(const plait_pair_params* params, float near) {
    return near + 0.501f * params->longest; /* and rounding */
}

/* Of a row of cells those from `first` on: they lie one after the other. */
static inline void pair_look_along(const pair_search* search, const pair_cells* cells, uint first,
                                   uint count, pair_list* list) {
    const uint end = cells->end[first + count - 1u];
    for (uint k = first > 0u ? cells->end[first - 1u] : 0u; k < end; k += PLAIT_LANES)
        pair_look_at(search, cells, k, end, list);
}

static inline void pair_look_in_row(const pair_search* search, const pair_cells* cells, uint row,
                                    int first_cell, int last_cell, pair_list* list) {
    const uint n = search->params->edge_count;
    const uint first = pair_wrapped(first_cell, n), count = (uint)(last_cell - first_cell + 1);
    const uint before = min(count, n - first); /* the end of the row */
    pair_look_along(search, cells, row + first, before, list);
    if (before < count)
        pair_look_along(search, cells, row, count - before, list);
}

/* The cell of its middle, where most of the nearest are: those leave little to look at in others. */
static inline void pair_look_in_own(const pair_search* search, const pair_axis* x,
                                    const pair_axis* y, const pair_axis* z, const pair_cells* cells,
                                    pair_list* list) {
    const int own = pair_cell_of(0.5f * x->way + x->from, x->edge);
    const int3 row = (int3)(0, pair_cell_of(0.5f * y->way + y->from, y->edge),
                            pair_cell_of(0.5f * z->way + z->from, z->edge));
    pair_look_in_row(search, cells, pair_number(row, search->params->edge_count), own, own, list);
}

/* Every cell that comes near the segment, not all of the box around it: of a row only what is near the
 * part of the segment that is near the row. Over lanes the rows of a layer are found at once. */
static inline void pair_look_around(const pair_search* search, const pair_axis* x,
                                    const pair_axis* y, const pair_axis* z, const pair_cells* cells,
                                    pair_list* list) {
    const uint n = search->params->edge_count;
    const float far = pair_far(search->params, pair_limit(search, list));
    const real reach = (real)(far), rounding = (real)(1e-3f * far);
    const pair_part whole = {(real)(0.0f), (real)(1.0f)};
    const pair_run layers = pair_cells_near(whole, z, reach, n);
    const float last_layer = LANE(layers.last, 0);
    for (float layer = LANE(layers.first, 0); layer <= last_layer; layer += 1.0f) {
        const pair_part slab = pair_near_cells(whole, z, (real)(layer), reach);
        const real beside = pair_left(reach * reach, whole, z, (real)(layer));
        const real reach_y = sqrt(beside) + rounding;
        const pair_run rows = pair_cells_near(slab, y, reach_y, n);
        const float last_row = LANE(rows.last, 0);
        for (float row = LANE(rows.first, 0); row <= last_row; row += (float)PLAIT_LANES) {
            const real numbers = pair_numbers(row);
            const pair_part part = pair_near_cells(slab, y, numbers, reach_y);
            const real reach_x = sqrt(pair_left(beside, slab, y, numbers)) + rounding;
            pair_run run = pair_cells_near(part, x, reach_x, n);
            for (uint lane = 0; lane < PLAIT_LANES && row + (float)lane <= last_row; ++lane) {
                const int first = (int)LANE(run.first, lane), last = (int)LANE(run.last, lane);
                const int3 begin = (int3)(0, (int)row + (int)lane, (int)layer);
                if (first <= last)
                    pair_look_in_row(search, cells, pair_number(begin, n), first, last, list);
            }
        }
    }
}

/* ---- one segment ------------------------------------------------------------------------------ */

/* The first lane of three components at place k. */
static inline float3 pair_read_one(const pair_cells* cells, uint component, uint k) {
    __global const float* from = cells->line + component * cells->stride + k;
    return (float3)(from[0], from[cells->stride], from[2 * cells->stride]);
}

static inline pair_axis pair_axis_of(const plait_pair_params* params, float from, float way) {
    const pair_axis axis = {from, way, params->voxel_edge, 1.0f / params->voxel_edge};
    return axis;
}

/* Blocks of cells along an axis in which the middle of a segment may lie that comes so near. */
static inline int2 pair_blocks_near(const plait_pair_params* params, float from, float way,
                                    float reach) {
    const int first =
        pair_block_of(pair_cell_of(fmin(from, from + way) - reach, params->voxel_edge));
    const int last =
        pair_block_of(pair_cell_of(fmax(from, from + way) + reach, params->voxel_edge));
    return (int2)(first, min(last, first + (int)pair_blocks(params) - 1));
}

/* m: the farthest that any vertex moves in a substep, of segments that the own one may meet. */
static inline float pair_others_move(const plait_pair_params* params, float3 from, float3 way,
                                     float most, __global const uint* cell_moves) {
    const float reach = pair_far(params, most);
    const int2 xs = pair_blocks_near(params, from.x, way.x, reach);
    const int2 ys = pair_blocks_near(params, from.y, way.y, reach);
    const int2 zs = pair_blocks_near(params, from.z, way.z, reach);
    uint moves = 0u; /* bits of floats above 0 are in the order of these */
    for (int z = zs.x; z <= zs.y; ++z)
        for (int y = ys.x; y <= ys.y; ++y)
            for (int x = xs.x; x <= xs.y; ++x)
                moves = max(moves, cell_moves[pair_number((int3)(x, y, z), pair_blocks(params))]);
    return as_float(moves);
}

/* For the segment at place k. */
static inline void pair_look_for(const plait_pair_params* params, const pair_cells* cells, uint k,
                                 __global const uint* cell_moves, pair_list* list) {
    const float3 from = pair_read_one(cells, PLAIT_PAIR_FROM, k);
    const float3 way = pair_read_one(cells, PLAIT_PAIR_WAY, k);
    const float3 moves = pair_read_one(cells, PLAIT_PAIR_MOVES, k);
    const float spread = cells->line[PLAIT_PAIR_SPREAD * cells->stride + k];
    pair_search search;
    search.params = params;
    search.item = cells->segment[k];
    search.root = search.item - search.item % params->vertex_stride;
    search.length = sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
    search.own.from = spread3(from);
    search.own.way = spread3(way);
    search.change = spread3(pair_read_one(cells, PLAIT_PAIR_CHANGE, k));
    search.middle = spread3(pair_read_one(cells, PLAIT_PAIR_MIDDLE, k));
    search.half_edges = spread3(pair_read_one(cells, PLAIT_PAIR_HALF, k));
    search.moves = spread3(moves);
    search.near = PLAIT_PAIR_NEAR * params->diameter;
    const float others =
        pair_others_move(params, from, way, search.near + params->room, cell_moves);
    const float own = sqrt(moves.x * moves.x + moves.y * moves.y + moves.z * moves.z) + spread;
    search.most = search.near + fmin(1.001f * params->steps * (own + others), params->room);
    const pair_axis x = pair_axis_of(params, from.x, way.x);
    const pair_axis y = pair_axis_of(params, from.y, way.y);
    const pair_axis z = pair_axis_of(params, from.z, way.z);
    search.rounding = 1e-6f * (length(from) + params->longest);
    pair_look_in_own(&search, &x, &y, &z, cells, list);
    pair_look_around(&search, &x, &y, &z, cells, list);
}

/* ---- what is kept ----------------------------------------------------------------------------- */

/* m: how far from each other a segment and those of a list lie at rest, in the lanes of which there are
 * some. */
static inline real pair_rest(__global const float4* rest, uint item, const pair_list* list,
                             uint first) {
    segment others = segment_at(rest, item);
    for (uint lane = 0; lane < PLAIT_LANES && first + lane < PLAIT_PAIR_COUNT; ++lane) {
        const uint other = list->segment[first + lane];
        if (other == PLAIT_PAIR_NONE)
            continue;
        const float3 from = rest[other].xyz;
        set_lane3(&others.from, lane, from);
        set_lane3(&others.way, lane, rest[other + 1].xyz - from);
    }
    const segment_foot foot = segment_nearest(segment_at(rest, item), others);
    return length3(foot.apart);
}

static inline void pair_store(__global const float4* rest, uint item, float diameter,
                              const pair_list* list, __global uint* pair_segment,
                              __global float* pair_offset) {
    for (uint first = 0; first < PLAIT_PAIR_COUNT; first += PLAIT_LANES) {
        const bool some = list->segment[first] != PLAIT_PAIR_NONE;
        const real apart = some ? pair_rest(rest, item, list, first) : (real)(0.0f);
        for (uint lane = 0; lane < PLAIT_LANES && first + lane < PLAIT_PAIR_COUNT; ++lane) {
            const uint k = first + lane, other = list->segment[k];
            const size_t at = (size_t)PLAIT_PAIR_COUNT * item + k;
            pair_segment[at] = other;
            pair_offset[at] = other == PLAIT_PAIR_NONE ? 0.0f : fmin(diameter, LANE(apart, lane));
        }
    }
}

__kernel PLAIT_WIDE void plait_contact_pair_find(
    const uint item_count, const plait_pair_params params, __global const uint* vertex_count,
    __global const float4* rest, __global const uint* cell_end, __global const uint* cell_segment,
    __global const float* cell_line, __global const uint* cell_moves, __global uint* pair_segment,
    __global float* pair_offset, __global uint* pair_dropped) {
    const uint item = get_global_id(0);
    if (item >= item_count)
        return;
    pair_list list;
    list.within = MAXFLOAT;
    for (uint k = 0; k < PAIR_PLACES; ++k) {
        list.distance[k] = MAXFLOAT;
        list.segment[k] = PLAIT_PAIR_NONE;
    }
    if (!pair_has_segment(vertex_count, item, params.vertex_stride))
        pair_store(rest, item, params.diameter, &list, pair_segment, pair_offset);
    const uint n = params.edge_count;
    if (item >= cell_end[n * n * n - 1u])
        return;
    const pair_cells cells = {cell_end, cell_segment, cell_line, pair_line_stride(item_count)};
    pair_look_for(&params, &cells, item, cell_moves, &list);
    pair_store(rest, cell_segment[item], params.diameter, &list, pair_segment, pair_offset);
    if (list.segment[PLAIT_PAIR_COUNT] != PLAIT_PAIR_NONE)
        atomic_add(pair_dropped, 1u);
}
