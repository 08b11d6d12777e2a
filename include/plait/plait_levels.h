/* Levels of detail: how many of a groom's strands are simulated, while the others follow them. Hair that is far
 * away, or one of many, needs few. This runs on the host and needs no context. The conventions are
 * those of plait.h. See docs/levels.md.
 */
#ifndef PLAIT_LEVELS_H
#define PLAIT_LEVELS_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PLAIT_LEVELS_MAX 6

typedef struct plait_levels plait_levels;

typedef struct plait_levels_desc {
    uint32_t struct_size;
    const plait_groom* groom; /* all strands; copied */
    /* float[3], m, each within 1e6 [strands][V], V any that holds the longest: where all strands hang,
       their bodies in place, as for plait_follow_map_bind: PLAIT_FIELD_POSITION, with a stride of 16
       bytes, of a sim of `groom` that has settled. Follows are bound there. Empty, the default: the
       hair hangs as groomed, as it does where the sim is sag-free. */
    plait_view hung;
    const plait_roots* roots; /* where they were then, without bones and mesh; NULL: as groomed */
    uint32_t level_count;     /* [0, PLAIT_LEVELS_MAX]; 0, the default: those that suit the groom */
    /* Of each level, falling, each [0, strands]: strands that are simulated. 0: none, the hair goes
       with the head as it hangs. Those that suit the groom are all, 512, 128, 32 and 0; of one of
       fewer than 2,000 strands all, an eighth, a 32nd and a 128th, none below 8, and 0. */
    uint32_t guides[PLAIT_LEVELS_MAX];
    uint64_t seed; /* of the first guide */
} plait_levels_desc;
PLAIT_STRUCT(plait_levels_desc)

/* Guides are spread evenly over the roots, and nested: those of a level are the first of every finer one's.
 * Takes strands x guides distances and a copy of the groom and of `hung`.
 * @errors INVALID_ARGUMENT (also a root that is more than 1 % of its strand's length from where `roots`
 *         put it, and a segment of `hung` without length), UNSUPPORTED (bones, mesh_positions) */
PLAIT_API plait_result plait_levels_create(const plait_levels_desc* desc, plait_levels** out);
PLAIT_API void plait_levels_destroy(plait_levels* levels);

typedef struct plait_level {
    uint32_t struct_size;
    uint32_t guides; /* strands that are simulated */
    /* About how far its hair is, rms, from where all of it would be in short steps, over how far the
       hair swings itself, rms about its mean in the head's frame: times that swing, the error to
       expect. Measured for three grooms and the same number of guides; within a factor of two. */
    float share;
} plait_level;
PLAIT_STRUCT(plait_level)

/* The finest first: a list. */
PLAIT_API plait_result plait_levels_list(const plait_levels* levels, plait_level* dst,
                                         size_t* count);

/* What a sim of a level is made of: its guides, for plait_sim_create, and what follows them, for
 * plait_sim_desc.follow_map. The sim's strands, guides first, come in one order whatever the level, which
 * PLAIT_FOLLOW_MAP_FIELD_STRANDS of any of the maps says: what is drawn by strand need not change with the
 * level. Caller owns both.
 * @errors INVALID_ARGUMENT (no such level, or one without guides) */
PLAIT_API plait_result plait_levels_take(const plait_levels* levels, size_t level,
                                         plait_groom** guides, plait_follow_map** map);

#ifdef __cplusplus
}
#endif

#endif
