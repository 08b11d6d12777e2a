/* mesh_contact: of each vertex the plane of a mesh that it may meet in a substep.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, collider, mesh_grid, mesh_nodes, mesh_field,
 *         mesh_clearance, lane_acceleration, lane_pin, lane_x, lane_v, and the steps before.
 * Writes  lane_plane.
 * Source  Baerentzen & Aanaes 2005 (signs of the field, made on the host); ours: the way from where
 *         the mesh would carry the vertex to where inertia puts it, walked by distances; strands
 *         looked through by what a distance says of the places around.
 */
#include "common/lane_mesh.clh"
#include "common/lane_step.clh"

/* A mesh over a substep. */
typedef struct {
    mesh_field field;
    float4 orientation; /* from its own frame to the world, at the end */
    float3 from, to;    /* where its origin is at the begin and at the end */
    float4 turn;        /* from the one to the other */
    float friction;
} mesh_body;

static inline mesh_body mesh_body_at(__global const float4* colliders, uint collider,
                                     mesh_field field) {
    __global const float4* row = colliders + PLAIT_COLLIDER_STRIDE * (size_t)collider;
    mesh_body body;
    body.field = field;
    body.orientation = row[PLAIT_COLLIDER_BEGIN + 1];
    body.from = row[PLAIT_COLLIDER_BEGIN].xyz;
    body.to = row[PLAIT_COLLIDER_END].xyz;
    body.turn = row[PLAIT_COLLIDER_TURN];
    body.friction = row[PLAIT_COLLIDER_FRICTION].x;
    return body;
}

/* A world point in the mesh's own frame. */
static inline vec3 mesh_own(const mesh_body* body, vec3 x) {
    const vec3 arm = vec3_of(x.x - body->to.x, x.y - body->to.y, x.z - body->to.z);
    return add3(arm, mesh_turn((float4)(-body->orientation.xyz, body->orientation.w), arm));
}

/* Where the mesh carries a point in the substep, less where it was. */
static inline vec3 mesh_carry(const mesh_body* body, vec3 x) {
    const float3 moves = body->to - body->from;
    const vec3 arm = vec3_of(x.x - body->from.x, x.y - body->from.y, x.z - body->from.z);
    const vec3 turned = mesh_turn(body->turn, arm);
    return vec3_of(moves.x + turned.x, moves.y + turned.y, moves.z + turned.z);
}

/* ---- which vertices are near -------------------------------------------------------------- */

/* Cells. A plane is taken where a sample is at most two: in a cell with a node of at most that, so
 * less than a cell's diagonal farther from the mesh. The rest is for rounding. */
#define MESH_NEAR (2.0f + 1.7321f + 0.05f)

/* The vertices to be looked at: lane k of row i as i * PLAIT_LANES + k, by rows. */
typedef struct {
    uint count;
    ushort at[PLAIT_VERTICES * PLAIT_LANES];
} mesh_list;

static inline void mesh_list_add(mesh_list* list, int i, mask near) {
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        list->at[list->count] = (ushort)((uint)i * PLAIT_LANES + k);
        list->count += LANE_OF_MASK(near, k) != 0;
    }
}

/* What moves, seen from where the mesh is at the substep's end. */
typedef struct {
    const lane_step* step;
    __global const real* x;
    vec3 shift;               /* of the root: at the begin less at the end */
    vec3 end[PLAIT_VERTICES]; /* where inertia, what pulls and pins put the vertices */
    real arc[PLAIT_VERTICES]; /* m, from the root */
} mesh_ways;

static inline vec3 mesh_begin(const mesh_ways* ways, int i) {
    return add3(load3(ways->x, ways->step->place, i), ways->shift);
}

/* Lists all vertices that may have a plane: of the others a distance looked up at one before them
 * says that their ways do not come near. What is not finite is listed. */
static inline void mesh_list_near(const mesh_body* body, const mesh_ways* ways, mesh_list* list) {
    const vec3 root = ways->step->pose.root;
    const float moves = length(body->to - body->from), turns = 2.0f * length(body->turn.xyz);
    const float reach = MESH_NEAR * body->field.edge + moves;
    const real arm =
        mesh_length(vec3_of(root.x - body->from.x, root.y - body->from.y, root.z - body->from.z));
    real least = (real)(-1.0f); /* m: the distance of the vertex before is no less */
    real along = (real)(0.0f);  /* m, of the chain of vertices */
    list->count = 0;
    for (int i = 1; i <= ways->step->segments; ++i) {
        const real chord = mesh_length(sub3(ways->end[i], ways->end[i - 1]));
        const real way = mesh_length(sub3(ways->end[i], mesh_begin(ways, i)));
        least -= chord;
        along += chord;
        const real meets = way + turns * (arm + along + way) + reach;
        if (!any_lane(!(least > meets)))
            continue;
        least =
            fmax(least, mesh_field_least(&body->field, mesh_own(body, add3(root, ways->end[i]))));
        const mask near = (!(least > meets)) &
                          (lane_material_at(ways->step, i - 1, PLAIT_LANE_LENGTH) > (real)(0.0f));
        if (any_lane(near))
            mesh_list_add(list, i, near);
    }
}

/* ---- their planes --------------------------------------------------------------------------- */

typedef struct {
    vec3 root, begin, end; /* m: the root in the world, of the vertex relative to it */
    real offset;           /* m, how far outside of its surface the mesh begins */
    real gap;              /* m, of the end of the way above the plane; before: no other is taken */
} mesh_vertex;

typedef struct {
    vec3 normal, anchor; /* in the world; m, relative to the root */
    real height, start;  /* m, of the anchor above the plane and above the surface */
    mask some;
} mesh_touch;

static inline mesh_touch mesh_meet(const mesh_body* body, mesh_vertex* vertex) {
    mesh_touch touch;
    touch.anchor = add3(vertex->begin, mesh_carry(body, add3(vertex->root, vertex->begin)));
    const vec3 from = mesh_own(body, add3(vertex->root, touch.anchor));
    const vec3 to = mesh_own(body, add3(vertex->root, vertex->end));
    const mesh_sample first = mesh_field_sample(&body->field, from);
    touch.start = first.distance - vertex->offset;
    touch.some = !(touch.start > mesh_length(sub3(to, from)) + (real)(2.0f * body->field.edge));
    mesh_plane plane = mesh_march(&body->field, from, to, vertex->offset, first, touch.some);
    touch.some &= mesh_plane_is(plane);
    if (!any_lane(touch.some))
        return touch;
    plane = mesh_plane_at_foot(&body->field, mesh_plane_unit(plane), to, vertex->offset);
    const real gap = mesh_plane_height(plane, to);
    touch.some &= !(gap >= vertex->gap);
    touch.normal = add3(plane.normal, mesh_turn(body->orientation, plane.normal));
    touch.height = mesh_plane_height(plane, from);
    return touch;
}

/* Of vertex i in lane k; its values are PLAIT_TILE floats apart. */
static inline __global float* mesh_plane_at(__global real* lane_plane, lane_place place, uint i,
                                            uint k) {
    return (__global float*)(lane_plane +
                             lane_index(place, PLAIT_LANE_PLANE_COMPONENTS, (size_t)i, 0)) +
           k;
}

/* The gap of what the meshes before have left. */
static inline float mesh_gap_left(__global const float* plane, float3 end) {
    float v[PLAIT_LANE_PLANE_COMPONENTS];
    for (int c = 0; c < PLAIT_LANE_PLANE_COMPONENTS; ++c)
        v[c] = plane[c * PLAIT_TILE];
    const float3 normal = (float3)(v[0], v[1], v[2]), way = end - (float3)(v[3], v[4], v[5]);
    const int some = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z > 0.0f;
    return some ? v[PLAIT_LANE_PLANE_HEIGHT] +
                      (normal.x * way.x + normal.y * way.y + normal.z * way.z)
                : MAXFLOAT;
}

/* No plane of vertex i in lane k. */
static inline void mesh_store_none(__global float* plane) {
    for (int c = 0; c < 3; ++c)
        plane[(PLAIT_LANE_PLANE_NORMAL + c) * PLAIT_TILE] = 0.0f;
}

static inline void mesh_store(__global float* plane, const mesh_touch* touch, float friction,
                              uint lane) {
    const float values[PLAIT_LANE_PLANE_COMPONENTS] = {
        LANE(touch->normal.x, lane), LANE(touch->normal.y, lane), LANE(touch->normal.z, lane),
        LANE(touch->anchor.x, lane), LANE(touch->anchor.y, lane), LANE(touch->anchor.z, lane),
        LANE(touch->height, lane),   LANE(touch->start, lane),    friction};
    for (int c = 0; c < PLAIT_LANE_PLANE_COMPONENTS; ++c)
        plane[c * PLAIT_TILE] = values[c];
}

/* What the vertices of one strand after another have of a mesh. */
typedef struct {
    const plait_lane_params* params;
    __global const float* clearance; /* [vertices][meshes] */
    uint mesh;
    lane_strands strands;
    real depth; /* m, of the roots; negative inside */
    mask* last; /* the last vertex with a plane */
    __global real* lane_plane;
} mesh_planes;

/* How far outside of the surface the mesh begins for a vertex `arc` from its root: what was measured
 * in the rest shape, and beside a root that the surface holds deeper no farther than half of arc. */
static inline real mesh_offset(real clearance, real depth, real arc) {
    return fmin(clearance, fmin(depth, (real)(0.0f)) + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
}

/* `count` of the listed vertices, one in each lane, the last one in those left over. */
static inline mesh_vertex mesh_gather(const mesh_ways* ways, const mesh_planes* planes,
                                      const ushort* list, uint count) {
    mesh_vertex vertex;
    real clearance, depth, arc;
    for (uint j = 0; j < PLAIT_LANES; ++j) {
        const uint at = list[min(j, count - 1)], i = at / PLAIT_LANES, k = at % PLAIT_LANES;
        const vec3* end = &ways->end[i];
        LANE(vertex.root.x, j) = LANE(ways->step->pose.root.x, k);
        LANE(vertex.root.y, j) = LANE(ways->step->pose.root.y, k);
        LANE(vertex.root.z, j) = LANE(ways->step->pose.root.z, k);
        LANE(vertex.end.x, j) = LANE(end->x, k);
        LANE(vertex.end.y, j) = LANE(end->y, k);
        LANE(vertex.end.z, j) = LANE(end->z, k);
        __global const float* x =
            (__global const float*)(ways->x + lane_index(ways->step->place, 3, i, 0)) + k;
        LANE(vertex.begin.x, j) = x[0] + LANE(ways->shift.x, k);
        LANE(vertex.begin.y, j) = x[PLAIT_TILE] + LANE(ways->shift.y, k);
        LANE(vertex.begin.z, j) = x[2 * PLAIT_TILE] + LANE(ways->shift.z, k);
        LANE(depth, j) = LANE(planes->depth, k);
        LANE(arc, j) = LANE(ways->arc[i], k);
        const size_t row = (size_t)planes->strands.at[k] * planes->params->row_stride + i;
        LANE(clearance, j) = planes->clearance[row * planes->params->collider_count + planes->mesh];
        float gap = MAXFLOAT;
        if (planes->mesh > 0 && (int)i <= LANE_OF_MASK(*planes->last, k))
            gap = mesh_gap_left(mesh_plane_at(planes->lane_plane, ways->step->place, i, k),
                                (float3)(LANE(end->x, k), LANE(end->y, k), LANE(end->z, k)));
        LANE(vertex.gap, j) = gap;
    }
    vertex.offset = mesh_offset(clearance, depth, arc);
    return vertex;
}

/* Rows after the last plane of a strand are not written. */
static inline void mesh_scatter(const mesh_ways* ways, const mesh_planes* planes,
                                const ushort* list, uint count, float friction,
                                const mesh_touch* touch) {
    for (uint j = 0; j < count; ++j) {
        if (!LANE_OF_MASK(touch->some, j))
            continue;
        const uint i = list[j] / PLAIT_LANES, k = list[j] % PLAIT_LANES;
        for (uint row = (uint)LANE_OF_MASK(*planes->last, k) + 1; row < i; ++row)
            mesh_store_none(mesh_plane_at(planes->lane_plane, ways->step->place, row, k));
        mesh_store(mesh_plane_at(planes->lane_plane, ways->step->place, i, k), touch, friction, j);
        LANE_OF_MASK(*planes->last, k) = max(LANE_OF_MASK(*planes->last, k), (int)i);
    }
}

static inline void mesh_find(const mesh_body* body, const mesh_ways* ways, const mesh_list* list,
                             mesh_planes* planes) {
    planes->depth = mesh_field_sample(&body->field, mesh_own(body, ways->step->pose.root)).distance;
    for (uint first = 0; first < list->count; first += PLAIT_LANES) {
        const uint count = min(list->count - first, (uint)PLAIT_LANES);
        mesh_vertex vertex = mesh_gather(ways, planes, &list->at[first], count);
        const mesh_touch touch = mesh_meet(body, &vertex);
        mesh_scatter(ways, planes, &list->at[first], count, body->friction, &touch);
    }
}

__kernel void plait_mesh_contact(const uint item_count, const plait_lane_params params,
                                 __global const uint* lane_strand, __global const float4* rest,
                                 __global const float4* pose, __global const real* lane_material,
                                 __global const float4* collider, __global const float4* mesh_grid,
                                 __global const uint* mesh_nodes, __global const float* mesh_values,
                                 __global const float* mesh_clearance,
                                 __global const real* lane_acceleration,
                                 __global const real* lane_pin, __global const real* lane_x,
                                 __global const real* lane_v, __global const real* lane_x_before,
                                 __global const real* lane_v_before, __global real* lane_plane) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    /* which lane_predict_vertex() does not write */
    const lane_buffers state = {(__global real*)lane_x, (__global real*)lane_v,
                                (__global real*)lane_x_before, (__global real*)lane_v_before};
    mesh_ways ways;
    ways.step = &step;
    ways.x = lane_x;
    ways.shift = sub3(load3(lane_x, step.place, 0), step.pose.root);
    ways.end[0] = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    ways.arc[0] = (real)(0.0f);
    const vec3 shift = lane_shift(&step, state);
    for (int i = 1; i <= step.segments; ++i) {
        vec3 w;
        lane_predict_vertex(&step, &params, state, shift, i, &ways.end[i], &w);
        ways.arc[i] = ways.arc[i - 1] + lane_material_at(&step, i - 1, PLAIT_LANE_LENGTH);
    }
    mask last = (mask)(0);
    mesh_planes planes;
    planes.params = &params;
    planes.clearance = mesh_clearance;
    planes.strands = lane_strands_of(lane_strand, step.place, item_count);
    planes.last = &last;
    planes.lane_plane = lane_plane;
    mesh_list list;
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const mesh_body body =
            mesh_body_at(collider, params.collider_first + mesh,
                         mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh));
        mesh_list_near(&body, &ways, &list);
        planes.mesh = mesh;
        if (list.count > 0)
            mesh_find(&body, &ways, &list, &planes);
    }
    lane_plane[lane_index(step.place, PLAIT_LANE_PLANE_COMPONENTS, 0, PLAIT_LANE_PLANE_LAST)] =
        LANE_REAL(last);
}
