/* Levels of detail: how many of a groom's strands are simulated, while the others follow them. Hair that is far
 * away, or one of many, needs few. A director says which of many heads gets which level. Levels are made on the host, without
 * a context. The conventions are those of plait.h. See docs/levels.md.
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
       bytes, of a sim of `groom` that has settled. Strands follow guides that grow and hang beside them,
       and are bound there. Empty, the default: the hair hangs as groomed, as it does where the sim is
       sag-free, and strands follow guides that grow beside them. */
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

/* ---- in a sim ------------------------------------------------------------------------------- */

/* A sim with plait_sim_desc.levels changes its level while it runs. Its groom is theirs; it takes
 * neither follows of its own nor the model tressfx. Its guides are those of level `level_top`, in the
 * order of PLAIT_FOLLOW_MAP_FIELD_STRANDS of any level. So are rows of POSITION and TANGENT, of all
 * strands, and whatever else has one for each guide; strand_stiffness and strand_material of
 * plait_sim_desc have one for each strand of the groom, in its order. The sim begins at `level_top`
 * and shows all strands. `levels` may go before it. */
typedef struct plait_level_choice {
    uint32_t struct_size;
    uint32_t level; /* [level_top, levels - 1]; default 0 */
    /* [0, strands]: how many are placed, those that come first; the rows of the others stay as they
       are. Rounded up to the guides of a level, an eighth, a quarter, a half of all, or all.
       Default 0: all */
    uint32_t shown;
    float blend; /* s, [0, 5], default 0.3: in which what is shown goes over to the new level */
    float rest;  /* m/s, [0, 1]: hair with no vertex faster may sleep; default 0: it never does */
} plait_level_choice;
PLAIT_STRUCT(plait_level_choice)

/* The next step is made and shown by the level as it is; what comes after it, by the new one. Does
 * not wait, and compiles nothing.
 *
 * Fewer guides: those that stay have the same bits as without a change. More: strands begin where they
 * are shown and as fast as what they followed; contacts begin as for a new strand. What is shown goes
 * on from where it is: what the new level lacks to it, in the frame of the root, fades in `blend`.
 * Until then lengths are off by as much as that varies along a strand. A level of no guides steps
 * nothing: all strands go with their roots as they were shown last.
 *
 * Sleep: when some strands have been slower than `rest` for half a second, and then every vertex, and no call has
 * changed anything meanwhile, plait_sim_step lets time pass and enqueues nothing. Any call that may change the sim
 * wakes it, and the next step goes on from the bits that it fell asleep with. A `rest` below the speed of the
 * hair wakes it, too. The roots, a body's pose or a level that were given last do not. Hair with
 * a wind, a frame, wetness, a reduction, or an `accelerate` of the caller's does not sleep. The device
 * says how fast hair is, and says it late: one run falls asleep earlier than another.
 *
 * Of strands that are not stepped VELOCITY is 0, what is written is ignored, and pins wait: they
 * hold again once the strand is stepped. Detail is of strands that follow at level_top, and where
 * there is some, all strands are placed. The shelter of a wind counts all hair, the pressure of a
 * volume only strands that are stepped. Snapshots hold level, shown and blend,
 * and a choice that waits for its step.
 * @errors INVALID_ARGUMENT, INVALID_STATE (a sim without levels) */
PLAIT_API plait_result plait_sim_set_level(plait_sim* sim, const plait_level_choice* choice);

typedef struct plait_level_state {
    uint32_t struct_size;
    uint32_t level;
    uint32_t shown;  /* strands */
    float blending;  /* s that are left */
    float swing;     /* m, rms of hair about its mean in the frames of its roots, over about 1 s, as
                        far as it has come from the device; of a level of no guides, the last one
                        before. < 0: not known yet */
    uint32_t asleep; /* 1: the next step enqueues nothing, unless something wakes the hair */
} plait_level_state;
PLAIT_STRUCT(plait_level_state)

/* As of the last step. Does not wait. @errors INVALID_STATE (a sim without levels) */
PLAIT_API plait_result plait_sim_get_level(plait_sim* sim, plait_level_state* state);

/* What a sim of one level is made of: its guides, for plait_sim_create, and what follows them, for
 * plait_sim_desc.follow_map. The sim's strands, guides first, come in one order whatever the level, which
 * PLAIT_FOLLOW_MAP_FIELD_STRANDS of any of the maps says: what is drawn by strand need not change with the
 * level. Caller owns both.
 * @errors INVALID_ARGUMENT (no such level, or one without guides) */
PLAIT_API plait_result plait_levels_take(const plait_levels* levels, size_t level,
                                         plait_groom** guides, plait_follow_map** map);

/* ---- who gets which ---------------------------------------------------------------------------- */

/* A head of hair, in this frame. */
typedef struct plait_character {
    uint32_t struct_size;
    plait_sim* sim; /* one without levels is passed over */
    /* Pixels that a metre has in the picture, where the head is, [0, 1e6]: the picture's height over
       2 tan(half the vertical view) times the distance. 0: nobody sees it. After a second it goes rigid
       where its levels have that. */
    float pixels_per_metre;
    float importance; /* [0, 1e3]; its errors count so much. Default 1 */
    /* m, [0, 1e3]: all its hairs side by side. What is shown of it must cover the head. Default 6.5, a
       head of 100,000 hairs; a beard has about 1, brows 0.1. */
    float width;
} plait_character;
PLAIT_STRUCT(plait_character)

typedef struct plait_director_desc {
    uint32_t struct_size;
    float budget_ms;    /* [0, 1e4], for the hair of all; 0, the default: none */
    float tolerance_px; /* [0.05, 100]; an error below it is not worth work. Default 2 */
    float hair_px;      /* [0.25, 8]; as wide as a hair may be drawn, default 1 */
    /* ms, [0, 1e4]: what all of the hair took in the last frame, by the caller's clock. 0, the default:
       not known. Without it prices are those of two cores. Two long frames in a row change nothing. */
    float last_ms;
    float hold_s; /* [0, 60]; a choice stands so long, unless all is over the budget. Default 0.5 */
    /* px/s, [0, 100]: hair slower than that may sleep, as by plait_level_choice.rest, of at most 0.05 m/s.
       Default 3; 0: none does */
    float rest_px;
} plait_director_desc;
PLAIT_STRUCT(plait_director_desc)

typedef struct plait_director_info {
    uint32_t struct_size;
    uint32_t passed_over; /* sims without levels */
    uint32_t changed;     /* choices, in this call */
    float predicted_ms;   /* what the hair should take now, by last_ms so far */
    float worst_px;       /* the greatest error of a character that is seen, without importance */
} plait_director_info;
PLAIT_STRUCT(plait_director_info)

/* Chooses level and shown strands of `count` different sims of `context`, and gives them to
 * plait_sim_set_level: from the next step on. To be called once a frame, before the sims are stepped; dt is
 * the frame's time, s, [0, 1e9]. `desc` NULL: the defaults. `info` may be NULL.
 *
 * A choice's error, px: 1.5 times the level's share of the hair's swing, and twice what shown strands are
 * drawn too wide, the root of their squares, times importance. Where the budget is short it goes to who
 * gains most by it. So that nobody sees it at work, a choice stands for hold_s, what is taken is preferred
 * by a quarter, and an eighth of the characters changes in a frame, two of them to a finer level; but who is
 * new or was unseen gets a choice at once, and what is over the budget is saved at once. A
 * choice depends on nothing but the arguments of the calls so far and the swing of each sim, and whether it sleeps.
 * @errors INVALID_ARGUMENT (a sim is NULL, of another context or in the list twice) */
PLAIT_API plait_result plait_context_direct(plait_context* context,
                                            const plait_character* characters, size_t count,
                                            const plait_director_desc* desc, double dt,
                                            plait_director_info* info);

#ifdef __cplusplus
}
#endif

#endif
