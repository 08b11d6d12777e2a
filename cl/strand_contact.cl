/* strand_contact: of each vertex the plane of another strand that it may meet in a substep.
 *
 * Items   strands, over lanes.
 * Reads   lane_strand, vertex_count, rest, pose, position, position_prev, pair_segment, pair_offset,
 *         lane_x; lane_plane, where it holds planes of meshes.
 * Writes  lane_plane: of both kinds the plane that the vertex is deeper under where it goes.
 * Source  Ericson 2005, 5.1.9 (segments); ours: what either strand does half of.
 */
#pragma OPENCL FP_CONTRACT OFF
#include "common/lane_step.clh"
#include "common/segment.clh"

typedef struct {
    float3 normal; /* towards the strand; 0: none */
    float3 moves;  /* m: what both contact points move by on the mean */
    float gap;     /* m: what is left of it, half for either strand */
    float height;  /* m, of the vertex above the plane where it goes */
} contact_plane;

typedef struct {
    __global const float4* position;
    __global const float4* before;
    __global const uint* pair_segment;
    __global const float* pair_offset;
} contact_state;

/* Takes the pairs of the segment that begins at `first`, of which `vertex` is one end. */
static inline void contact_of_segment(const contact_state* state, uint first, uint vertex,
                                      contact_plane* deepest) {
    const segment own = segment_at(state->position, first);
    const float3 goes = state->position[vertex].xyz - state->before[vertex].xyz;
    for (uint k = 0; k < PLAIT_PAIR_COUNT; ++k) {
        const size_t at = (size_t)PLAIT_PAIR_COUNT * first + k;
        const uint other = state->pair_segment[at];
        if (other == PLAIT_PAIR_NONE)
            break;
        const segment_foot foot = segment_nearest(own, segment_at(state->position, other));
        const float share = vertex == first ? 1.0f - foot.s : foot.s;
        const float distance = segment_length(foot.apart);
        if (!(share > PLAIT_PAIR_SHARE) || !(distance > PLAIT_PAIR_LEAST))
            continue;
        contact_plane plane;
        plane.normal = foot.apart / distance;
        plane.moves = 0.5f * (segment_moves(state->position, state->before, first, foot.s) +
                              segment_moves(state->position, state->before, other, foot.t));
        plane.gap = 0.5f * (distance - state->pair_offset[at]);
        plane.height = plane.gap + segment_dot(plane.normal, goes - plane.moves);
        if (plane.height < deepest->height)
            *deepest = plane;
    }
}

/* One strand of a work-item, whose values in the lanes are PLAIT_TILE floats apart. */
typedef struct {
    __global const float* x;
    __global float* plane;
    float3 shift; /* m, of the root: at the begin less now */
    uint first;   /* its root in rows of all strands */
    uint last;    /* its tip */
} contact_strand;

static inline float3 contact_begin(const contact_strand* strand, uint i) {
    return lane_read(strand->x, (size_t)i * 3 * PLAIT_TILE, PLAIT_TILE) + strand->shift;
}

/* m: of vertex i, which goes by `goes`, above the plane of a mesh; MAXFLOAT where there is none. */
static inline float contact_mesh_height(const contact_strand* strand, uint i, float3 begin,
                                        float3 goes) {
    __global const float* plane =
        strand->plane + (size_t)i * PLAIT_LANE_PLANE_COMPONENTS * PLAIT_TILE;
    const float3 normal = lane_read(plane, PLAIT_LANE_PLANE_NORMAL * PLAIT_TILE, PLAIT_TILE);
    if (!(segment_dot(normal, normal) > 0.0f))
        return MAXFLOAT;
    const float3 anchor = lane_read(plane, PLAIT_LANE_PLANE_ANCHOR * PLAIT_TILE, PLAIT_TILE);
    return plane[PLAIT_LANE_PLANE_HEIGHT * PLAIT_TILE] + segment_dot(normal, begin + goes - anchor);
}

static inline void contact_store(const contact_strand* strand, uint i, float3 begin, float friction,
                                 const contact_plane* found) {
    __global float* plane = strand->plane + (size_t)i * PLAIT_LANE_PLANE_COMPONENTS * PLAIT_TILE;
    lane_write(plane, PLAIT_LANE_PLANE_NORMAL * PLAIT_TILE, PLAIT_TILE, found->normal);
    lane_write(plane, PLAIT_LANE_PLANE_ANCHOR * PLAIT_TILE, PLAIT_TILE, begin + found->moves);
    plane[PLAIT_LANE_PLANE_HEIGHT * PLAIT_TILE] = found->gap;
    plane[PLAIT_LANE_PLANE_START * PLAIT_TILE] = found->gap;
    plane[PLAIT_LANE_PLANE_FRICTION * PLAIT_TILE] = friction;
}

static inline void contact_of_strand(const contact_strand* strand, const contact_state* state,
                                     const plait_strand_contact_params* params) {
    __global float* last = strand->plane + PLAIT_LANE_PLANE_LAST * PLAIT_TILE;
    const uint meshes_to = params->meshes ? (uint)*last : 0u;
    uint planes_to = 0u;
    for (uint i = 1u; i <= strand->last; ++i) {
        const uint vertex = strand->first + i;
        contact_plane deepest = {(float3)(0.0f), (float3)(0.0f), 0.0f, MAXFLOAT};
        contact_of_segment(state, vertex - 1u, vertex, &deepest);
        if (i < strand->last)
            contact_of_segment(state, vertex, vertex, &deepest);
        const float3 begin = contact_begin(strand, i);
        const float3 goes = state->position[vertex].xyz - state->before[vertex].xyz;
        const float mesh = i <= meshes_to ? contact_mesh_height(strand, i, begin, goes) : MAXFLOAT;
        if (deepest.height < mesh || !(mesh < MAXFLOAT))
            contact_store(strand, i, begin, params->friction, &deepest);
        if (fmin(deepest.height, mesh) < MAXFLOAT)
            planes_to = i;
    }
    *last = (float)planes_to;
}

__kernel void plait_strand_contact(const uint item_count, const plait_strand_contact_params params,
                                   __global const uint* lane_strand,
                                   __global const uint* vertex_count, __global const float4* rest,
                                   __global const float4* pose, __global const float4* position,
                                   __global const float4* position_prev,
                                   __global const uint* pair_segment,
                                   __global const float* pair_offset, __global const real* lane_x,
                                   __global real* lane_plane) {
    const lane_place place = lane_place_of(get_global_id(0));
    if (!lane_place_used(place, item_count))
        return;
    const contact_state state = {position, position_prev, pair_segment, pair_offset};
    const lane_strands strands = lane_strands_of(lane_strand, place, item_count);
    const lane_pose root = lane_load_pose(rest, pose, &strands, params.row_stride);
    const vec3 shift = sub3(load3(lane_x, place, 0), root.root);
    for (uint k = 0; k < PLAIT_LANES; ++k) {
        contact_strand strand;
        strand.x = (__global const float*)(lane_x + lane_index(place, 3, 0, 0)) + k;
        strand.plane =
            (__global float*)(lane_plane + lane_index(place, PLAIT_LANE_PLANE_COMPONENTS, 0, 0)) +
            k;
        strand.shift = (float3)(LANE(shift.x, k), LANE(shift.y, k), LANE(shift.z, k));
        strand.first = strands.at[k] * params.row_stride;
        strand.last = vertex_count[strands.at[k]] - 1u;
        contact_of_strand(&strand, &state, &params);
    }
}
