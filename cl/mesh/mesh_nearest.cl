/* mesh_nearest: of each vertex the plane of a mesh that it may meet in a substep, by the nearest
 * triangle of the mesh as it bends.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, rest, pose, lane_material, collider, mesh_first, mesh_box, mesh_tree,
 *         mesh_triangle, mesh_ring, mesh_from, mesh_to, mesh_bends, mesh_clearance,
 *         lane_acceleration, lane_pin, lane_x, lane_v, and the steps before.
 * Writes  lane_plane, which holds planes of other meshes where params.planes is 1; mesh_side and lane_hollow of
 *         sheets.
 * Source  Ericson 2005, 5.1.5; Baerentzen & Aanaes 2005; ours: the way as in mesh_field, carried
 *         by the nearest triangle.
 */
#include "mesh/lane_nearest.clh"
#include "mesh/mesh_planes.clh"
#include "mesh/near_hollow.clh"

/* A mesh over a substep. */
typedef struct {
    near_mesh mesh;
    mesh_motion motion;
    float begin, end; /* shares of the fixed step */
    float bends;      /* m: how far a vertex goes at most in the substep, in the mesh's own frame */
} near_body;

static inline near_body near_body_at(__global const float4* colliders, uint collider,
                                     near_mesh mesh) {
    __global const float4* row = colliders + PLAIT_COLLIDER_STRIDE * (size_t)collider;
    near_body body;
    body.mesh = mesh;
    body.motion = mesh_motion_at(colliders, collider);
    body.begin = row[PLAIT_COLLIDER_BEGIN].w;
    body.end = row[PLAIT_COLLIDER_END].w;
    body.bends = mesh.bends * (body.end - body.begin);
    return body;
}

/* m: how far the mesh carries a vertex at most, and within what of the surface it has a plane.
 * `arm`: m, of the vertex. */
static inline real near_reach(const near_body* body, real arm) {
    const float moves = length(body->motion.to - body->motion.from),
                turns = 2.0f * length(body->motion.turn.xyz);
    return moves + turns * arm + (body->bends + 1.5f * PLAIT_MESH_ROOM);
}

/* The way of a vertex in the mesh's own frame. */
typedef struct {
    vec3 anchor; /* m, relative to the root in the world: where its pose alone carries the vertex */
    vec3 rigid, to; /* m: that, and where the way ends */
} near_way;

static inline near_way near_way_of(const near_body* body, const mesh_ways* ways, int i) {
    const vec3 root = ways->step->pose.root, begin = mesh_begin(ways, i), from = add3(root, begin);
    near_way at;
    at.anchor = add3(begin, mesh_carry(&body->motion, from));
    at.rigid = mesh_own(&body->motion, add3(from, mesh_carry(&body->motion, from)));
    at.to = mesh_own(&body->motion, add3(root, ways->end[i]));
    return at;
}

/* ---- their planes --------------------------------------------------------------------------- */

/* Where the mesh carries x, a point of its frame at the begin: what it has under it keeps its place
 * in the triangle, and it its place over it, turned as the normal there is. What is far above is not
 * thrown about: no farther than the mesh bends, and PLAIT_MESH_ROOM/2. */
static inline vec3 near_carried(const near_body* body, const near_found* found, vec3 x) {
    vec3 carried = x;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const int triangle = LANE_OF_MASK(found->triangle, k);
        if (triangle < 0)
            continue;
        __global const uint* corner =
            body->mesh.triangle + PLAIT_MESH_TRIANGLE_STRIDE * (size_t)triangle;
        const float3 a = near_vertex(&body->mesh, corner[0], body->begin),
                     ab = near_vertex(&body->mesh, corner[1], body->begin) - a,
                     ac = near_vertex(&body->mesh, corner[2], body->begin) - a;
        const float3 a_end = near_vertex(&body->mesh, corner[0], body->end),
                     ab_end = near_vertex(&body->mesh, corner[1], body->end) - a_end,
                     ac_end = near_vertex(&body->mesh, corner[2], body->end) - a_end;
        const float3 point =
            (float3)(LANE(found->point.x, k), LANE(found->point.y, k), LANE(found->point.z, k));
        const float3 own = point - a, face = cross(ab, ac);
        const int place = LANE_OF_MASK(found->place, k);
        const float3 n = near_outward_of(&body->mesh, (uint)triangle, place, body->begin).normal,
                     n_end = near_outward_of(&body->mesh, (uint)triangle, place, body->end).normal;
        const float area = dot(face, face), square = dot(n, n), square_end = dot(n_end, n_end);
        if (!(area > 0.0f && square > 0.0f && square_end > 0.0f))
            continue;
        const float v = dot(cross(own, ac), face) / area, w = dot(cross(ab, own), face) / area;
        const float3 above = (float3)(LANE(x.x, k), LANE(x.y, k), LANE(x.z, k)) - point;
        const float scale = rsqrt(square * square_end);
        const float3 axis = cross(n, n_end) * scale; /* the turn's, as long as its sine */
        const float cosine = dot(n, n_end) * scale;
        const float3 first = cross(axis, above);
        const float3 turned = above + first + cross(axis, first) / (1.0f + fmax(cosine, -0.9f));
        const float3 moved = a_end + v * ab_end + w * ac_end + turned - point - above;
        const float most = body->bends + 0.5f * PLAIT_MESH_ROOM;
        const float3 allowed = moved * fmin(1.0f, most / fmax(length(moved), 1e-9f));
        LANE(carried.x, k) += allowed.x;
        LANE(carried.y, k) += allowed.y;
        LANE(carried.z, k) += allowed.z;
    }
    return carried;
}

/* ---- sides of a sheet ----------------------------------------------------------------------- */

/* What mesh_side holds of the vertices of a row. */
typedef struct {
    vec3 from;
    real side;
} near_side;

static inline size_t near_side_at(const mesh_planes* planes, int i, uint k) {
    const size_t row = (size_t)planes->strands.at[k] * planes->params->row_stride + (uint)i;
    return row * planes->params->collider_count + planes->mesh;
}

static inline near_side near_side_load(const mesh_planes* planes, __global const float4* sides,
                                       int i) {
    near_side last;
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        const float4 was = sides[near_side_at(planes, i, k)];
        LANE(last.from.x, k) = was.x;
        LANE(last.from.y, k) = was.y;
        LANE(last.from.z, k) = was.z;
        LANE(last.side, k) = was.w;
    }
    return last;
}

/* Forgets what is out of reach; most has nothing to forget. Lanes past the last strand repeat its name,
 * and not its state. */
static inline void near_side_store(const mesh_planes* planes, __global float4* sides, int i,
                                   const near_side* last, const near_side* now) {
    for (uint k = 0; k < planes->lanes; ++k) {
        const float side = LANE(now->side, k);
        if (side != 0.0f)
            sides[near_side_at(planes, i, k)] =
                (float4)(LANE(now->from.x, k), LANE(now->from.y, k), LANE(now->from.z, k), side);
        else if (LANE(last->side, k) != 0.0f)
            sides[near_side_at(planes, i, k)] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
    }
}

static inline void near_side_forget(const mesh_planes* planes, __global float4* sides, int i) {
    for (uint k = 0; k < planes->lanes; ++k) {
        const size_t at = near_side_at(planes, i, k);
        if (sides[at].w != 0.0f)
            sides[at] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
    }
}

/* Does the way from a to b pass through a triangle? Also by its edges. */
static inline int near_pierced(const near_mesh* mesh, uint triangle, float share, float3 a,
                               float3 b) {
    __global const uint* corner = mesh->triangle + PLAIT_MESH_TRIANGLE_STRIDE * (size_t)triangle;
    const float3 o = near_vertex(mesh, corner[0], share),
                 u = near_vertex(mesh, corner[1], share) - o,
                 v = near_vertex(mesh, corner[2], share) - o;
    const float3 way = b - a, n = cross(u, v), out = a - o;
    const float down = -dot(way, n), height = dot(out, n);
    if (down == 0.0f || height * down < 0.0f || fabs(height) > fabs(down))
        return 0;
    const float3 e = cross(out, way);
    const float p = dot(v, e) / down, q = -dot(u, e) / down;
    return p >= -PLAIT_MESH_EDGE && q >= -PLAIT_MESH_EDGE && p + q <= 1.0f + PLAIT_MESH_EDGE;
}

/* And through any of a mesh? */
static inline int near_passes(const near_mesh* mesh, float share, float3 a, float3 b) {
    const float3 low = fmin(a, b), high = fmax(a, b);
    uint left[PLAIT_MESH_TREE_DEPTH];
    uint depth = 0, node = 0;
    for (;;) {
        const float3 from = mesh->box[2 * (size_t)node].xyz,
                     to = mesh->box[2 * (size_t)node + 1].xyz;
        const int meets = all(low <= to) && all(high >= from);
        const uint first = mesh->tree[2 * (size_t)node], number = mesh->tree[2 * (size_t)node + 1];
        if (meets && number == 0 && depth < PLAIT_MESH_TREE_DEPTH) {
            left[depth++] = first;
            ++node;
            continue;
        }
        for (uint i = 0; meets && i < number; ++i)
            if (near_pierced(mesh, first + i, share, a, b))
                return 1;
        if (depth == 0)
            return 0;
        node = left[--depth];
    }
}

/* The side of a sheet to which a vertex belongs that is on side `own` of it, `at` in its frame at the
 * substep's begin: the one it was on, unless it went round a rim. */
static inline real near_side_of(const near_body* body, const near_side* last, real own, vec3 at,
                                mask some) {
    const real one = (real)(1.0f), zero = (real)(0.0f);
    const mask known = last->side != zero;
    const real was = pick(last->side < zero, -one, one);
    const mask astray = fabs(last->side) > (real)(0.75f * PLAIT_MESH_SIDE_ASTRAY);
    real side = pick(known, was, own);
    const mask crossed = some & known & (!astray) & (own != was);
    for (uint k = 0; any_lane(crossed) && k < PLAIT_LANES; ++k)
        if (LANE_OF_MASK(crossed, k) &&
            !near_passes(
                &body->mesh, body->begin,
                (float3)(LANE(last->from.x, k), LANE(last->from.y, k), LANE(last->from.z, k)),
                (float3)(LANE(at.x, k), LANE(at.y, k), LANE(at.z, k))))
            LANE(side, k) = LANE(own, k);
    return side;
}

/* Seen from the side on which it came; beyond a rim a sheet has no sides. */
static inline mesh_plane near_plane(const near_body* body, const near_sample* sample, vec3 point,
                                    real offset, real* side) {
    real sign = (real)(1.0f);
    if (body->mesh.two_sided) {
        const real own = pick(sample->distance < (real)(0.0f), (real)(-1.0f), (real)(1.0f));
        *side = pick(sample->rim, own, *side);
        sign = *side;
    }
    const real far = body->mesh.two_sided ? sign * sample->distance : fabs(sample->distance);
    const mask some = sample->some & (far <= (real)(PLAIT_MESH_ROOM));
    const vec3 none = vec3_of((real)(0.0f), (real)(0.0f), (real)(0.0f));
    const mesh_plane plane = {pick3(some, scale3(sample->normal, sign), none), point,
                              sign * sample->distance - offset};
    return plane;
}

/* As mesh_march() in lane_mesh.clh, by true distances, which need no least step. */
static inline mesh_plane near_march(const near_body* body, vec3 from, vec3 to, real offset,
                                    mesh_plane known, real* side, mask on) {
    mesh_plane nearest = known;
    const vec3 way = sub3(to, from);
    const real one = (real)(1.0f), size = mesh_length(way), per_m = one / fmax(size, (real)(1e-9f));
    real distance = nearest.height, t = (real)(0.0f);
    for (int k = 0; k < PLAIT_MESH_MARCH_STEPS; ++k) {
        on &= (distance >= (real)(PLAIT_MESH_MARCH_LEAST)) & (t < one);
        if (!any_lane(on))
            break;
        const real before = t;
        t = pick(on, fmin(t + distance * per_m, one), t);
        const vec3 at = axpy3(t, way, from);
        /* no farther than it was and the step */
        const real bound = fabs(distance + offset) + (t - before) * size + (real)(1e-5f);
        const near_sample sample = near_sample_of(
            &body->mesh, near_search(&body->mesh, body->end, at, bound, on), body->end, at);
        real turned = *side;
        const mesh_plane next = near_plane(body, &sample, at, offset, &turned);
        const mask found = on & sample.some;
        *side = pick(found, turned, *side);
        distance = pick(found, next.height, distance);
        on &= found;
        const mask nearer = found & mesh_plane_is(next) &
                            ((!mesh_plane_is(nearest)) | (next.height < nearest.height));
        nearest = mesh_plane_pick(nearer, next, nearest);
    }
    return nearest;
}

/* That of where the way ends, if it is of one side with `plane` and no farther off it than the way
 * is long: what slides round a bend is else held on the tangent of where it was. */
static inline mesh_plane near_plane_at_end(mesh_plane plane, mesh_plane end, real way) {
    const real off = fabs(end.height - mesh_plane_height(plane, end.point));
    const mask agree = (off < way + (real)(PLAIT_MESH_MARCH_LEAST)) &
                       (dot3(end.normal, plane.normal) > (real)(PLAIT_SWEEP_SAME_SIDE));
    const mask taken = mesh_plane_is(end) & (agree | !mesh_plane_is(plane));
    return mesh_plane_pick(taken, end, plane);
}

/* m: what a distance near x may be off. */
static inline real near_rounding(vec3 x) {
    return (real)(1e-5f) + 1e-6f * mesh_length(x);
}

/* Of a row, in the lanes `near`. `there`: at the end of the way; `last`: of sheets, what was known of
 * their sides, and what is from now on. `wall`: the plane, if there is one. */
static inline mesh_touch near_meet(const near_body* body, const near_way* at,
                                   const near_sample* there, real offset, real gap, mask near,
                                   near_side* last, near_wall* wall) {
    mesh_touch touch;
    /* m: f at the end of the way, from where no place is farther off the mesh than it is from there */
    const real nearest = fabs(there->distance) + near_rounding(at->to);
    vec3 from = at->rigid;
    const real drift = mesh_length(sub3(at->to, at->rigid));
    if (body->mesh.bends > 0.0f) {
        const real most = drift + (real)(body->bends + 2 * PLAIT_MESH_ROOM);
        const near_found under =
            near_search(&body->mesh, body->begin, at->rigid,
                        fmin(most, nearest + drift + (real)(body->bends)), near);
        from = near_carried(body, &under, at->rigid);
    }
    touch.anchor = add3(at->anchor, mesh_turned(&body->motion, sub3(from, at->rigid)));
    const real way = mesh_length(sub3(at->to, from)), room = way + (real)(PLAIT_MESH_ROOM);
    const near_sample first =
        near_sample_of(&body->mesh,
                       near_search(&body->mesh, body->end, from,
                                   fmin(room + fmax(offset, (real)(0.0f)), nearest + way), near),
                       body->end, from);
    real side = pick(first.distance < (real)(0.0f), (real)(-1.0f), (real)(1.0f));
    if (body->mesh.two_sided) {
        const real own = side;
        side = near_side_of(body, last, own, at->rigid, first.some & !first.rim);
        side = pick(first.rim, own, side);
        last->from = from;
        const mask known = first.some & (fabs(first.distance) <= room);
        last->side =
            pick(known, pick(side == own, side, PLAIT_MESH_SIDE_ASTRAY * side), (real)(0.0f));
    }
    mesh_plane plane = near_plane(body, &first, from, offset, &side);
    wall->side = body->mesh.two_sided ? side : (real)(1.0f);
    touch.start = plane.height;
    touch.some = first.some & (touch.start <= room);
    /* from neither end of the way the sheet is nearer */
    const real ends = pick(first.some, 0.5f * (fabs(first.distance) - nearest - way), -way);
    wall->room = fmax(nearest + ends, (real)(PLAIT_MESH_ROOM));
    wall->near = near & (fabs(there->distance) <= 2.0f * way + (real)(3 * PLAIT_MESH_ROOM));
    wall->some = touch.some;
    if (!any_lane(touch.some))
        return touch;
    real side_there = side;
    const mesh_plane end = near_plane(body, there, at->to, offset, &side_there);
    /* else all of the way is nearer to one of its ends than the mesh is */
    const mask crosses = touch.some & (touch.start + end.height < way);
    if (any_lane(crosses))
        plane = near_march(body, from, at->to, offset, plane, &side, crosses);
    plane = near_plane_at_end(plane, end, way);
    touch.some &= mesh_plane_is(plane);
    wall->some = touch.some;
    touch.some &= !(mesh_plane_height(plane, at->to) >= gap);
    touch.normal = mesh_turned(&body->motion, plane.normal);
    touch.height = mesh_plane_height(plane, from);
    wall->from = from;
    wall->to = at->to;
    wall->plane = plane;
    wall->offset = offset;
    return touch;
}

/* Of the tips of a row, in the lanes that touch. A sheet has none: what is hollow of it is in lane_hollow. */
static inline void near_meet_creases(const near_body* body, const near_wall* wall, mask tip,
                                     mesh_touch* touch) {
    touch->tip = touch->some & tip;
    touch->crease.some = tip & !tip;
    if (body->mesh.two_sided || !any_lane(touch->tip))
        return;
    touch->crease = near_crease(&body->mesh, body->end, wall, touch->tip);
    touch->crease.normal = mesh_turned(&body->motion, touch->crease.normal);
}

/* m, of the roots of strands that have a vertex near; negative inside. */
static inline real near_depth(const near_body* body, const mesh_ways* ways) {
    const real none = (real)(0.0f);
    if (body->mesh.two_sided)
        return none;
    const vec3 root = mesh_own(&body->motion, ways->step->pose.root);
    const near_sample at = near_sample_of(
        &body->mesh,
        near_search(&body->mesh, body->end, root, (real)(PLAIT_MESH_ROOT_DEPTH), root.x == root.x),
        body->end, root);
    return pick(at.some, at.distance, none);
}

/* Row by row, root to tip: a search from where a way ends tells whether anything is near there, and
 * how far it is no nearer, so that rows are passed over that are nearer to each other than the mesh is. */
static inline void near_find(const near_body* body, const mesh_ways* ways, mesh_planes* planes,
                             __global float4* sides, __global real* lane_hollow) {
    const vec3 root = ways->step->pose.root;
    const real arm = mesh_arm(&body->motion, root);
    real least = (real)(-1.0f); /* m: the distance of the vertex before is no less */
    real along = (real)(0.0f);  /* m, of the chain of vertices */
    int deep = 0;
    for (int i = 1; i <= ways->step->segments; ++i) {
        const real chord = mesh_length(sub3(ways->end[i], ways->end[i - 1]));
        const real size = mesh_length(sub3(ways->end[i], mesh_begin(ways, i)));
        least -= chord;
        along += chord;
        real meets = size + near_reach(body, arm + along + size);
        if (body->mesh.two_sided) /* what begins near and goes off is remembered */
            meets *= 2.0f;
        const mask need = (!(least > meets)) &
                          (lane_material_at(ways->step, i - 1, PLAIT_LANE_LENGTH) > (real)(0.0f));
        if (!any_lane(need)) {
            if (body->mesh.two_sided)
                near_side_forget(planes, sides, i);
            continue;
        }
        const near_way at = near_way_of(body, ways, i);
        const near_found last = near_search(&body->mesh, body->end, at.to, meets, need);
        const mask near = need & (last.triangle >= 0);
        least = pick(near, sqrt(fmax(last.squared, (real)(0.0f))), fmax(least, meets));
        if (!any_lane(near)) {
            if (body->mesh.two_sided)
                near_side_forget(planes, sides, i);
            continue;
        }
        const near_sample there = near_sample_of(&body->mesh, last, body->end, at.to);
        if (!deep)
            planes->depth = near_depth(body, ways);
        deep = 1;
        const mesh_vertex vertex = mesh_row(ways, planes, i);
        near_side was = {vertex.begin, (real)(0.0f)};
        if (body->mesh.two_sided)
            was = near_side_load(planes, sides, i);
        near_side now = was;
        near_wall wall;
        mesh_touch touch =
            near_meet(body, &at, &there, vertex.offset, vertex.gap, near, &now, &wall);
        touch.some &= near;
        near_meet_creases(body, &wall, vertex.tip, &touch);
        if (body->mesh.two_sided) {
            now.side = pick(near, now.side, (real)(0.0f));
            near_side_store(planes, sides, i, &was, &now);
        }
        mesh_scatter_row(ways, planes, i, body->motion.friction, &touch);
        const lane_place place = ways->step->place;
        if (lane_hollow && body->mesh.two_sided)
            near_room(touch.anchor, wall.room, wall.near & !wall.some, place, i, lane_hollow);
        if (lane_hollow && any_lane(touch.some)) {
            wall.some = touch.some;
            near_hollows(&body->mesh, body->end, &body->motion, &wall, place, i, lane_hollow);
        }
    }
}

__kernel PLAIT_WIDE void plait_mesh_nearest(
    const uint item_count, const plait_lane_params params, __global const uint* lane_strand,
    __global const float4* rest, __global const float4* pose, __global const real* lane_material,
    __global const float4* collider, __global const uint* mesh_first,
    __global const float4* mesh_box, __global const uint* mesh_tree,
    __global const uint* mesh_triangle, __global const uint* mesh_ring,
    __global const float4* mesh_from, __global const float4* mesh_to,
    __global const float* mesh_bends, __global const float* mesh_clearance,
    __global const real* lane_acceleration, __global const real* lane_pin,
    __global const real* lane_x, __global const real* lane_v, __global const real* lane_x_before,
    __global const real* lane_v_before, __global real* lane_plane, __global float4* mesh_side,
    __global real* lane_hollow) {
    lane_step step;
    if (!lane_begin(&step, item_count, &params, lane_strand, rest, pose, lane_material,
                    lane_acceleration, lane_pin))
        return;
    /* which lane_predict_vertex() does not write */
    const lane_buffers state = {(__global real*)lane_x, (__global real*)lane_v,
                                (__global real*)lane_x_before, (__global real*)lane_v_before};
    const size_t head =
        lane_index(step.place, PLAIT_LANE_PLANE_COMPONENTS, 0, PLAIT_LANE_PLANE_LAST);
    mask last = params.planes ? LANE_INT(lane_plane[head]) : (mask)(0);
    if (!params.planes)
        mesh_clear_creases(lane_plane, step.place);
    mesh_planes planes;
    planes.params = &params;
    planes.clearance = mesh_clearance;
    planes.strands = lane_strands_of(lane_strand, step.place, item_count);
    planes.lanes = min((uint)PLAIT_LANES, item_count - (uint)(step.place.tile * PLAIT_TILE +
                                                              step.place.part * PLAIT_LANES));
    planes.last = &last;
    planes.lane_plane = lane_plane;
    mesh_fetch_clearance(&planes);
    mesh_ways ways;
    mesh_ways_of(&ways, &step, &params, state);
    for (int i = 1; params.hollows && i <= step.segments; ++i)
        lane_hollow[lane_index(step.place, PLAIT_LANE_HOLLOW_COMPONENTS, (size_t)i,
                               PLAIT_LANE_HOLLOW_KIND)] = (real)(PLAIT_HOLLOW_NONE);
    for (uint mesh = 0; mesh < params.collider_count; ++mesh) {
        const near_body body =
            near_body_at(collider, params.collider_first + mesh,
                         near_mesh_at(mesh_first, mesh_box, mesh_tree, mesh_triangle, mesh_ring,
                                      mesh_from, mesh_to, mesh_bends, mesh));
        planes.mesh = mesh;
        planes.others = mesh > 0 || params.planes;
        near_find(&body, &ways, &planes, mesh_side, params.hollows ? lane_hollow : 0);
    }
    lane_plane[head] = LANE_REAL(last);
}
