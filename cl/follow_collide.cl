/* follow_collide: strands that follow are turned out of colliders.
 *
 * Items   follows: strand f here is row guide_count + f of position.
 * Reads   collider, at the end of its substep.
 * Moves   position of the follows; w is kept, padding is a copy of the tip.
 * Source  common/follow_out.clh; distances as in the strand models.
 * Limit   without friction, and of no memory: a follow is where its guides put it, less what is
 *         inside. A strand that leaves one collider may be brought into one before it in the list.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_collider.clh"

typedef struct {
    float kind;
    lane_collider collider;
} follow_body;

typedef lane_gap follow_distance;

static inline follow_distance follow_gap(const follow_body* body, vec3 x, float bound) {
    if (body->kind == PLAIT_KIND_CAPSULE) {
        /* that to the capsule with the greater radius all along takes no division */
        const lane_capsule* capsule = &body->collider.capsule;
        const vec3 from = sub3(x, capsule->a);
        const float along =
            clamp(dot3(from, capsule->axis) * capsule->inverse, capsule->low, capsule->high);
        const float wide = fmax(capsule->radius, capsule->radius - capsule->taper);
        const follow_distance least = {zero3(), length3(axpy3(-along, capsule->axis, from)) - wide};
        if (least.distance > 0.0f)
            return least;
    }
    return lane_collider_gap(body->kind, &body->collider, zero3(), x);
}

#include "common/follow_out.clh"

typedef struct {
    float3 low, high;
} follow_box;

static inline follow_box follow_box_of(__global const float4* row, uint stride) {
    follow_box box = {row[0].xyz, row[0].xyz};
    for (uint i = 1; i < stride; ++i) {
        box.low = min(box.low, row[i].xyz);
        box.high = max(box.high, row[i].xyz);
    }
    return box;
}

__kernel void plait_follow_collide(const uint item_count, const plait_follow_collide_params params,
                                   __global const float4* collider, __global float4* position) {
    const uint item = get_global_id(0), stride = params.vertex_stride;
    if (item >= item_count)
        return;
    __global float4* row = follow_row(position, &params, item);
    follow_box box = follow_box_of(row, stride);
    for (uint k = 0; k < params.collider_count; ++k) {
        const uint index = params.collider_first + k;
        if (!lane_collider_meets(collider + PLAIT_COLLIDER_STRIDE * (size_t)index, box.low,
                                 box.high, 0.0f))
            continue;
        follow_body body;
        body.kind = lane_collider_kind(collider, index);
        body.collider = lane_collider_at(body.kind, collider, index);
        lane_collider_ready(body.kind, &body.collider);
        if (follow_leave(&body, row, stride))
            box = follow_box_of(row, stride);
    }
}
