/* mesh_contact: of each vertex the plane of a mesh that it may meet in a substep.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, collider, mesh_grid, mesh_nodes, mesh_field,
 *         mesh_clearance, lane_acceleration, lane_pin, lane_x, lane_v, and the steps before.
 * Writes  lane_plane.
 * Source  Baerentzen & Aanaes 2005 (signs of the field, made on the host); ours: the way from where
 *         the mesh would carry the vertex to where inertia puts it, walked by distances.
 */
#include "common/lane_step.clh"
#include "common/mesh.clh"

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
static inline float3 mesh_own(const mesh_body* body, float3 x) {
    const float3 arm = x - body->to;
    return arm + mesh_turn((float4)(-body->orientation.xyz, body->orientation.w), arm);
}

/* Where the mesh carries a point in the substep, less where it was. */
static inline float3 mesh_carry(const mesh_body* body, float3 x) {
    return (body->to - body->from) + mesh_turn(body->turn, x - body->from);
}

typedef struct {
    float3 normal, anchor; /* in the world; m, relative to the root */
    float height, start;   /* m, of the anchor above the plane and above the surface */
    float friction;
    float gap; /* m, of the end of the way above the plane */
} mesh_touch;

/* `begin` and `end`, relative to `root`: of the vertex in this substep, by inertia alone. False: no
 * plane of less gap than touch->gap. */
static inline int mesh_meet(const mesh_body* body, float3 root, float3 begin, float3 end,
                            float offset, mesh_touch* touch) {
    const float3 anchor = begin + mesh_carry(body, root + begin);
    const float3 from = mesh_own(body, root + anchor), to = mesh_own(body, root + end);
    const mesh_sample first = mesh_field_sample(&body->field, from);
    const float start = first.distance - offset;
    if (start > mesh_length(to - from) + 2.0f * body->field.edge)
        return 0;
    mesh_plane plane = mesh_march(&body->field, from, to, offset, first);
    if (!mesh_plane_is(plane))
        return 0;
    plane = mesh_plane_at_foot(&body->field, plane, to, offset);
    const float gap = mesh_plane_height(plane, to);
    if (gap >= touch->gap)
        return 0;
    touch->normal = plane.normal + mesh_turn(body->orientation, plane.normal);
    touch->anchor = anchor;
    touch->height = mesh_plane_height(plane, from);
    touch->start = start;
    touch->friction = body->friction;
    touch->gap = gap;
    return 1;
}

static inline float3 lane3(vec3 v, uint lane) {
    return (float3)(LANE(v.x, lane), LANE(v.y, lane), LANE(v.z, lane));
}

/* Of vertex i in lane k; its values are PLAIT_TILE floats apart. */
static inline __global float* mesh_touch_at(__global real* lane_plane, lane_place place, int i,
                                            uint k) {
    return (__global float*)(lane_plane +
                             lane_index(place, PLAIT_LANE_PLANE_COMPONENTS, (size_t)i, 0)) +
           k;
}

static inline void mesh_store(__global float* plane, const mesh_touch* touch) {
    const float values[PLAIT_LANE_PLANE_COMPONENTS] = {
        touch->normal.x, touch->normal.y, touch->normal.z, touch->anchor.x, touch->anchor.y,
        touch->anchor.z, touch->height,   touch->start,    touch->friction};
    for (int c = 0; c < PLAIT_LANE_PLANE_COMPONENTS; ++c)
        plane[c * PLAIT_TILE] = values[c];
}

/* The gap of what the meshes before have left. */
static inline float mesh_gap_left(__global const float* plane, float3 end) {
    float v[PLAIT_LANE_PLANE_COMPONENTS];
    for (int c = 0; c < PLAIT_LANE_PLANE_COMPONENTS; ++c)
        v[c] = plane[c * PLAIT_TILE];
    const float3 normal = (float3)(v[0], v[1], v[2]), anchor = (float3)(v[3], v[4], v[5]);
    const int some = mesh_dot(normal, normal) > 0.0f;
    return some ? v[PLAIT_LANE_PLANE_HEIGHT] + mesh_dot(normal, end - anchor) : MAXFLOAT;
}

/* How far outside of the surface the mesh begins for a vertex `arc` from its root: what was measured
 * in the rest shape, and beside a root that the surface holds deeper no farther than half of arc. */
static inline float mesh_offset(float clearance, float root, float arc) {
    return fmin(clearance, fmin(root, 0.0f) + PLAIT_CONTACT_ROOT_CLEARANCE * arc);
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
    /* which lane_predict() does not write */
    const lane_buffers state = {(__global real*)lane_x, (__global real*)lane_v,
                                (__global real*)lane_x_before, (__global real*)lane_v_before};
    const lane_strands strands = lane_strands_of(lane_strand, step.place, item_count);
    vec3 y[PLAIT_VERTICES], w[PLAIT_VERTICES];
    lane_predict(&step, &params, state, y, w);
    const vec3 shift = sub3(load3(lane_x, step.place, 0), step.pose.root);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const mesh_body body =
            mesh_body_at(collider, params.collider_first + mesh,
                         mesh_field_at(mesh_grid, mesh_nodes, mesh_values, mesh));
        for (uint k = 0; k < PLAIT_LANES; ++k) {
            const float3 root = lane3(step.pose.root, k);
            const float depth = mesh_field_sample(&body.field, mesh_own(&body, root)).distance;
            const size_t first = (size_t)strands.at[k] * params.row_stride;
            float arc = 0.0f;
            for (int i = 0; i <= step.segments; ++i) {
                __global float* const plane = mesh_touch_at(lane_plane, step.place, i, k);
                mesh_touch touch = {(float3)(0.0f), (float3)(0.0f), 0.0f, 0.0f, 0.0f, MAXFLOAT};
                if (mesh == 0)
                    mesh_store(plane, &touch);
                if (i == 0)
                    continue;
                const real length = lane_material_at(&step, i - 1, PLAIT_LANE_LENGTH);
                const float own = LANE(length, k);
                const float3 end = lane3(y[i], k);
                const vec3 begin = add3(load3(lane_x, step.place, i), shift);
                arc += own;
                touch.gap = mesh_gap_left(plane, end);
                const float clearance =
                    mesh_clearance[(first + (size_t)i) * params.collider_count + mesh];
                if (own > 0.0f && mesh_meet(&body, root, lane3(begin, k), end,
                                            mesh_offset(clearance, depth, arc), &touch))
                    mesh_store(plane, &touch);
            }
        }
    }
}
