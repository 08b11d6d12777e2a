/* follow_collide: strands that follow are turned out of colliders.
 *
 * Items   follows, over lanes: follow f is row guide_count + f of position.
 * Reads   lane_strand; collider, at the end of its substep.
 * Moves   position of the follows; w is kept, padding is a copy of the tip.
 * Source  follows/follow_out.clh; distances as in the solve.
 * Limit   without friction, and of no memory: a follow is where its guides put it, less what is
 *         inside. A strand that leaves one collider may be brought into one before it in the list.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "contact/lane_collider.clh"

typedef struct {
    float kind;
    lane_collider collider;
    __global const float4* colliders;
    uint index;
} follow_body;

typedef lane_gap follow_distance;

LANES_INLINE follow_distance follow_gap(const follow_body* body, vec3 x, real bound, mask on) {
    if (lane_collider_is_inward(body->kind))
        return lane_inward_gap(body->kind, body->colliders, body->index, zero3(), x);
    if (body->kind != PLAIT_KIND_CAPSULE)
        return lane_collider_gap(body->kind, &body->collider, zero3(), x);
    /* that to the capsule with the greater radius all along takes no division */
    const lane_capsule* capsule = &body->collider.capsule;
    const vec3 axis = spread3(capsule->axis), from = sub3(x, spread3(capsule->a));
    const real along =
        clamp(dot3(from, axis) * capsule->inverse, (real)(capsule->low), (real)(capsule->high));
    const float wide = fmax(capsule->radius, capsule->radius - capsule->taper);
    const real least = length3(axpy3(-along, axis, from)) - wide;
    const mask outside = least > (real)(0.0f);
    follow_distance gap = {zero3(), least};
    if (any_lane(on & !outside)) {
        gap = lane_collider_gap(PLAIT_KIND_CAPSULE, &body->collider, zero3(), x);
        gap.distance = pick(outside, least, gap.distance);
    }
    return gap;
}

#include "follows/follow_out.clh"

/* The boxes around strands. */
typedef struct {
    vec3 low, high;
} follow_boxes;

static inline follow_boxes follow_boxes_of(const follow_rows* rows) {
    const vec3 root = follow_row(rows, 0);
    follow_boxes box = {root, root};
    for (uint i = 1; i < PLAIT_VERTICES; ++i) {
        const vec3 x = follow_row(rows, i);
        box.low = vec3_of(fmin(box.low.x, x.x), fmin(box.low.y, x.y), fmin(box.low.z, x.z));
        box.high = vec3_of(fmax(box.high.x, x.x), fmax(box.high.y, x.y), fmax(box.high.z, x.z));
    }
    return box;
}

/* May they hold any of the collider? As lane_collider_meets. */
static inline mask follow_boxes_meet(const follow_boxes* box, __global const float4* row) {
    const float4 a = row[PLAIT_COLLIDER_END], b = row[PLAIT_COLLIDER_END + 1];
    if (lane_collider_is_inward(row[PLAIT_COLLIDER_FRICTION].y))
        return box->low.x == box->low.x;
    if (row[PLAIT_COLLIDER_FRICTION].y == PLAIT_KIND_PLANE) {
        const real half_of = (real)(0.5f);
        const vec3 middle = scale3(add3(box->low, box->high), half_of);
        const vec3 size = scale3(sub3(box->high, box->low), half_of);
        return dot3(spread3(b.xyz), sub3(middle, spread3(a.xyz))) <=
               dot3(spread3(fabs(b.xyz)), size);
    }
    const lane_bounds bounds = lane_collider_bounds(row);
    return (box->low.x <= bounds.high.x) & (box->high.x >= bounds.low.x) &
           (box->low.y <= bounds.high.y) & (box->high.y >= bounds.low.y) &
           (box->low.z <= bounds.high.z) & (box->high.z >= bounds.low.z);
}

/* Strands of those that are `on` of which a vertex is not surely outside, and the first such vertex. */
static inline mask follow_inside(const follow_body* body, const follow_rows* rows, mask on,
                                 uint* first) {
    mask inside = (mask)(0);
    *first = PLAIT_VERTICES;
    for (uint i = PLAIT_VERTICES; i-- > 0;) {
        const vec3 x = follow_row(rows, i);
        const mask beyond =
            lane_collider_is_inward(body->kind)
                ? lane_inward_gap(body->kind, body->colliders, body->index, zero3(), x).distance >=
                      (real)(0.0f)
                : lane_collider_beyond(body->kind, &body->collider, zero3(), x, (real)(0.0f));
        const mask held = on & !beyond;
        if (any_lane(held))
            *first = i;
        inside |= held;
    }
    return inside;
}

__kernel PLAIT_WIDE void plait_follow_collide(const uint item_count,
                                              const plait_follow_collide_params params,
                                              __global const uint* lane_strand,
                                              __global const float4* collider,
                                              __global float4* position) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    follow_rows rows;
    follow_rows_read(&rows, position, params.guide_count, lane_strand, place, item_count);
    follow_boxes box = follow_boxes_of(&rows);
    mask moved = (mask)(0);
    for (uint k = 0; k < params.collider_count; ++k) {
        const uint index = params.collider_first + k;
        const mask meets =
            follow_boxes_meet(&box, collider + PLAIT_COLLIDER_STRIDE * (size_t)index);
        if (!any_lane(meets))
            continue;
        follow_body body;
        body.kind = lane_collider_kind(collider, index);
        body.collider = lane_collider_at(body.kind, collider, index);
        body.colliders = collider;
        body.index = index;
        uint first;
        const mask inside = follow_inside(&body, &rows, meets, &first);
        if (!any_lane(inside))
            continue;
        lane_collider_ready(body.kind, &body.collider);
        const mask turned = follow_leave(&body, &rows, inside, first);
        if (any_lane(turned))
            box = follow_boxes_of(&rows);
        moved |= turned;
    }
    follow_rows_write(&rows, moved, lane_place_strands(place, item_count));
}
