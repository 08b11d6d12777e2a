/* strand_contact: of each vertex the plane of another strand that it may meet in a substep.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, rest, pose, position, position_prev, pair_segment, pair_offset,
 *         lane_x; lane_plane, where it holds planes of meshes.
 * Writes  lane_plane: of both kinds the plane that the vertex is deeper under where it goes.
 * Source  Ericson 2005, 5.1.9 (segments); ours: what either strand does half of.
 */
#pragma OPENCL FP_CONTRACT OFF
#undef PLAIT_LANES /* strand by strand: their pairs have nothing to do with each other */
#include "base/lane.clh"
#include "base/lane_scalar.clh"
#include "base/pose.clh"
#include "strand_contact/segment.clh"

typedef struct {
    vec3 normal;  /* towards the strand; 0: none */
    vec3 moves;   /* m: what both contact points move by on the mean */
    float gap;    /* m: what is left of it, half for either strand */
    float height; /* m, of the vertex above the plane where it goes */
} contact_plane;

typedef struct {
    __global const float4* position;
    __global const float4* before;
    __global const uint* pair_segment;
    __global const float* pair_offset;
} contact_state;

static inline contact_plane contact_none(void) {
    const contact_plane plane = {zero3(), zero3(), 0.0f, MAXFLOAT};
    return plane;
}

static inline vec3 contact_goes(const contact_state* state, uint vertex) {
    return sub3(unpack3(state->position[vertex]), unpack3(state->before[vertex]));
}

/* Of a vertex with so much of the contact point. */
static inline void contact_take(contact_plane plane, float share, vec3 goes,
                                contact_plane* deepest) {
    const float height = plane.gap + dot3(plane.normal, sub3(goes, plane.moves));
    if (share > PLAIT_PAIR_SHARE && height < deepest->height) {
        *deepest = plane;
        deepest->height = height;
    }
}

/* Takes the pairs of the segment that begins at `first` for both of its ends. */
static inline void contact_of_segment(const contact_state* state, uint first, contact_plane* begin,
                                      contact_plane* end) {
    const segment own = segment_at(state->position, first);
    const segment_motion motion = segment_motion_at(state->position, state->before, first);
    const vec3 begin_goes = contact_goes(state, first), end_goes = contact_goes(state, first + 1u);
    for (uint k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        const size_t at = (size_t)PLAIT_PAIR_COUNT * first + k;
        const uint other = state->pair_segment[at];
        if (other == PLAIT_PAIR_NONE)
            break;
        const segment_foot foot = segment_nearest(own, segment_at(state->position, other));
        const float distance = length3(foot.apart);
        if (!(distance > PLAIT_PAIR_LEAST))
            continue;
        const segment_motion its = segment_motion_at(state->position, state->before, other);
        contact_plane plane;
        plane.normal = div3(foot.apart, distance);
        plane.moves = scale3(add3(segment_moves(motion, foot.s), segment_moves(its, foot.t)), 0.5f);
        plane.gap = 0.5f * (distance - state->pair_offset[at]);
        contact_take(plane, 1.0f - foot.s, begin_goes, begin);
        contact_take(plane, foot.s, end_goes, end);
    }
}

/* A strand, whose values in the lanes are PLAIT_TILE floats apart. */
typedef struct {
    lane_place place;
    __global const float* x;
    __global float* plane;
    vec3 shift; /* m, of the root: at the begin less now */
    uint first; /* its root in rows of all strands */
    uint last;  /* its tip */
} contact_strand;

static inline __global float* contact_plane_at(const contact_strand* strand, uint i,
                                               uint component) {
    return strand->plane + lane_index(strand->place, PLAIT_LANE_PLANE_COMPONENTS, i, component);
}

/* m: of vertex i, which goes by `goes`, above the plane of a mesh; MAXFLOAT where there is none. */
static inline float contact_mesh_height(const contact_strand* strand, uint i, vec3 begin,
                                        vec3 goes) {
    const vec3 normal =
        lane_read3(contact_plane_at(strand, i, PLAIT_LANE_PLANE_NORMAL), 0, PLAIT_TILE);
    if (!(dot3(normal, normal) > 0.0f))
        return MAXFLOAT;
    const vec3 anchor =
        lane_read3(contact_plane_at(strand, i, PLAIT_LANE_PLANE_ANCHOR), 0, PLAIT_TILE);
    return *contact_plane_at(strand, i, PLAIT_LANE_PLANE_HEIGHT) +
           dot3(normal, sub3(add3(begin, goes), anchor));
}

static inline void contact_store(const contact_strand* strand, uint i, vec3 begin, float friction,
                                 const contact_plane* found) {
    lane_write3(contact_plane_at(strand, i, PLAIT_LANE_PLANE_NORMAL), 0, PLAIT_TILE, found->normal);
    lane_write3(contact_plane_at(strand, i, PLAIT_LANE_PLANE_ANCHOR), 0, PLAIT_TILE,
                add3(begin, found->moves));
    *contact_plane_at(strand, i, PLAIT_LANE_PLANE_HEIGHT) = found->gap;
    *contact_plane_at(strand, i, PLAIT_LANE_PLANE_START) = found->gap;
    *contact_plane_at(strand, i, PLAIT_LANE_PLANE_FRICTION) = friction;
}

/* Keeps of what is found for vertex i and of the plane of a mesh there the deeper one. Is there any? */
static inline bool contact_keep(const contact_strand* strand, const contact_state* state, uint i,
                                bool mesh_there, float friction, const contact_plane* found) {
    const vec3 begin = add3(load3(strand->x, strand->place, i), strand->shift);
    const vec3 goes = contact_goes(state, strand->first + i);
    const float mesh = mesh_there ? contact_mesh_height(strand, i, begin, goes) : MAXFLOAT;
    if (found->height < mesh || !(mesh < MAXFLOAT))
        contact_store(strand, i, begin, friction, found);
    return fmin(found->height, mesh) < MAXFLOAT;
}

static inline void contact_of_strand(const contact_strand* strand, const contact_state* state,
                                     const plait_strand_contact_params* params) {
    __global float* last = contact_plane_at(strand, 0, PLAIT_LANE_PLANE_LAST);
    const uint meshes_to = params->meshes ? (uint)*last : 0u;
    uint planes_to = 0u;
    contact_plane here = contact_none(); /* of the root, which has none */
    for (uint i = 0u; i <= strand->last; ++i) {
        contact_plane next = contact_none();
        if (i < strand->last)
            contact_of_segment(state, strand->first + i, &here, &next);
        if (i > 0u && contact_keep(strand, state, i, i <= meshes_to, params->friction, &here))
            planes_to = i;
        here = next;
    }
    *last = (float)planes_to;
}

__kernel PLAIT_WIDE void
plait_strand_contact(const uint item_count, const plait_strand_contact_params params,
                     __global const uint* lane_strand, __global const uint* vertex_count,
                     __global const float4* rest, __global const float4* pose,
                     __global const float4* position, __global const float4* position_prev,
                     __global const uint* pair_segment, __global const float* pair_offset,
                     __global const real* lane_x, __global real* lane_plane) {
    const contact_state state = {position, position_prev, pair_segment, pair_offset};
    const uint first = (uint)get_global_id(0) * PLAIT_DEVICE_LANES;
    if (first >= item_count)
        return;
    for (uint k = 0; k < PLAIT_DEVICE_LANES; ++k) {
        const uint at = lane_strand_of(lane_strand, min(first + k, item_count - 1u));
        const pose_t root = pose_load(pose, at);
        contact_strand strand;
        strand.place = lane_place_of(first + k); /* lanes past the last repeat it */
        strand.x = lane_x;
        strand.plane = lane_plane;
        strand.first = at * params.row_stride;
        strand.last = vertex_count[at] - 1u;
        strand.shift =
            sub3(load3(lane_x, strand.place, 0), pose_apply(root, unpack3(rest[strand.first])));
        contact_of_strand(&strand, &state, &params);
    }
}
