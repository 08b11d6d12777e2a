/* Tools for the time before a simulation: maps of strands that follow, capsules that stand for a
 * mesh, the material of a fibre, the table of parameters. They run on the host and need no context.
 * The conventions are those of plait.h.
 */
#ifndef PLAIT_OFFLINE_H
#define PLAIT_OFFLINE_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- strands that follow --------------------------------------------------------------------- */

/* Strands that are not simulated: each follows up to four guides, which are, by weights. For
 * plait_sim_desc.follow_map; made of arrays here, of a groom by plait_groom_guides. See
 * docs/follows.md. */
typedef struct plait_follow_map_desc {
    uint32_t struct_size;
    const plait_groom* follows; /* the strands, at rest, in the space of the guides' groom */
    uint32_t guide_count;       /* strands of the guides' groom, at least 1 */
    plait_view guides;  /* uint32_t[4] [follows], each below guide_count; of weight 0 not read */
    plait_view weights; /* float[4] [follows], each [0, 1], of a strand sum 1 within 1e-3 */
    /* float[3], m, each within 1e6 [vertices of all guides, strand after strand]: where the guides
       are while `follows` are as given here. Follows take the turns since then. Empty, the default:
       as their groom has them. plait_sim_create refuses another count, a root that is more than
       1 % of its guide's length from the groom's, and segments without length. */
    plait_view guides_bound;
} plait_follow_map_desc;
PLAIT_STRUCT(plait_follow_map_desc)
PLAIT_API plait_result plait_follow_map_create(const plait_follow_map_desc* desc,
                                               plait_follow_map** out);
PLAIT_API void plait_follow_map_destroy(plait_follow_map* map);

typedef enum plait_follow_map_field {
    PLAIT_FOLLOW_MAP_FIELD_GUIDES = 0,  /* uint32_t[4] [follows], the greatest weight first */
    PLAIT_FOLLOW_MAP_FIELD_WEIGHTS = 1, /* float[4] [follows], sum 1 */
    /* uint32_t [guides and follows], in the order of a sim's strands: the strand's number in the
       groom that plait_groom_guides chose from; none of a map made of arrays */
    PLAIT_FOLLOW_MAP_FIELD_STRANDS = 2,
    PLAIT_FOLLOW_MAP_FIELD_FORCE_32 = 0x7fffffff
} plait_follow_map_field;

/* Bytes. */
PLAIT_API plait_result plait_follow_map_read(const plait_follow_map* map,
                                             plait_follow_map_field field, void* dst, size_t* size);

/* The same guides and weights, bound where hair hangs. Hair settles from its groom, guide and follow
 * each in its own way; where turns are taken since the groom that difference stays in all motion, and
 * most of what follows are wrong by is that. `map`: of plait_groom_guides, a learner, or any other;
 * `groom` has its strands, as plait_follow_learner_create takes them, `roots` and `positions` are as
 * for plait_follow_learner_add_frame: the PLAIT_FIELD_POSITION of a sim of all strands at rest, its
 * bodies in place. All are copied. Weights do not change; learn them with a bound map. A sim costs the
 * same but 16 bytes for each of the guides' vertices.
 * @errors INVALID_ARGUMENT (also another number of strands than the map's, or of vertices of a
 *         follow; a root that is more than 1 % of its guide's length from where `roots` put it; a
 *         segment without length), UNSUPPORTED (bones, mesh_positions) */
PLAIT_API plait_result plait_follow_map_bind(const plait_follow_map* map, const plait_groom* groom,
                                             const plait_roots* roots, plait_view positions,
                                             plait_follow_map** out);

/* Chooses `guides` strands of a groom, [1, all of them], whose roots are spread evenly, as a groom
 * of their own, `out`, and makes all others follow the four nearest to them on their side of a
 * parting (directions within 60 degrees), the nearer the more. The same groom and seed give the
 * same strands. Takes strands x guides distances. */
PLAIT_API plait_result plait_groom_guides(const plait_groom* groom, size_t guides, uint64_t seed,
                                          plait_groom** out, plait_follow_map** map);

/* ---- weights of follows, learnt -------------------------------------------------------------- */

typedef struct plait_follow_learner plait_follow_learner;

/* Learns a map's weights from hair in motion, all of whose strands are simulated: those shares of
 * its guides, none negative, sum 1, that put a follow nearest to where it was, in the sum of
 * squares over vertices and frames (Chai, Zheng & Zhou 2014; docs/follows.md). A follow keeps the
 * guides to which the map gives some weight.
 *
 * `groom` has the map's strands, in the order that PLAIT_FOLLOW_MAP_FIELD_STRANDS says, or, of a
 * map without, its guides and then its follows. Of a bound map the groom's shapes are not read: turns
 * are taken since they hung as bound. Both are copied. Takes 40 bytes a vertex, 160 a
 * follow and 32 for each of the guides' vertices, however many the frames. A learner is used by one
 * thread at a time; different ones are independent.
 * @errors INVALID_ARGUMENT (also another number of strands than the map's, or of vertices of a
 *         follow) */
PLAIT_API plait_result plait_follow_learner_create(const plait_groom* groom,
                                                   const plait_follow_map* map,
                                                   plait_follow_learner** out);
PLAIT_API void plait_follow_learner_destroy(plait_follow_learner* learner);

/* One frame more: where all strands are, in the groom's order, and where the roots are then.
 * `positions`: float[3], m, each within 1e6 [strands][V], V any that holds the longest:
 * PLAIT_FIELD_POSITION of a sim of `groom` with a stride of 16 bytes. `roots`: as for
 * plait_sim_set_roots, at any scale, with root_poses for all strands. Nothing is kept of either.
 * @errors UNSUPPORTED (bones, mesh_positions) */
PLAIT_API plait_result plait_follow_learner_add_frame(plait_follow_learner* learner,
                                                      const plait_roots* roots,
                                                      plait_view positions);

/* rms distance of the follows' vertices from where they were, m, over all frames. */
typedef struct plait_follow_fit_info {
    uint32_t struct_size;
    uint64_t frames;
    double rms_before; /* with the map's own weights */
    double rms_after;  /* with those learnt, to first order in what they change */
} plait_follow_fit_info;
PLAIT_STRUCT(plait_follow_fit_info)

/* A map with the weights that all frames so far teach; guides whose weight is 0 are gone from it.
 * More frames may be added, and a map learnt again. `info` may be NULL.
 * @errors INVALID_STATE (no frame was added) */
PLAIT_API plait_result plait_follow_learner_learn(const plait_follow_learner* learner,
                                                  plait_follow_map** out,
                                                  plait_follow_fit_info* info);

/* ---- capsules for a mesh --------------------------------------------------------------------- */

#define PLAIT_MESH_FIT_MAX 64

/* How far the surface of a mesh is from that of the capsules that stand for it, m. */
typedef struct plait_mesh_fit_info {
    uint32_t struct_size;
    double rms;
    double percentile_99;
    double greatest;
} plait_mesh_fit_info;
PLAIT_STRUCT(plait_mesh_fit_info)

/* `count` [1, PLAIT_MESH_FIT_MAX] capsules whose union comes near `mesh`, for
 * plait_collider_create: cheaper to meet than a mesh, and for both models. They are in the mesh's
 * frame; the same mesh gives the same. 16 take a second, 64 six. `out` may be NULL. */
PLAIT_API plait_result plait_mesh_fit(const plait_mesh* mesh, plait_capsule* dst, size_t count,
                                      plait_mesh_fit_info* out);

/* ---- material of a fibre --------------------------------------------------------------------- */

/* Material and section of a hair. */
typedef struct plait_fibre {
    uint32_t struct_size;
    float density;        /* kg/m^3, [1, 1e5], default 1300 */
    float radius;         /* m, [1e-7, 0.1], default 35e-6; of an ellipse the larger half axis */
    float flatness;       /* the smaller half axis / radius, [0.05, 1], default 1 */
    float youngs_modulus; /* Pa, [0, 1e13], default 4e9 */
    float shear_modulus;  /* Pa, [0, 1e13], default 1.5e9 */
} plait_fibre;
PLAIT_STRUCT(plait_fibre)

/* Sets line_density, bend_stiffness, twist_stiffness and section_ratio of `material` to those of a
 * fibre of elliptic section; it bends about the longer axis most easily. The rest stays.
 * @source  beam theory: A = pi a b, EI = E pi a b^3/4, GJ = G pi a^3 b^3/(a^2 + b^2). */
PLAIT_API plait_result plait_material_set_fibre(plait_material* material, const plait_fibre* fibre);

/* ---- table of parameters --------------------------------------------------------------------- */

typedef enum plait_param_kind {
    PLAIT_PARAM_KIND_FLOAT = 0,
    PLAIT_PARAM_KIND_UINT = 1,
    PLAIT_PARAM_KIND_CHOICE = 2, /* an enum */
    PLAIT_PARAM_KIND_FORCE_32 = 0x7fffffff
} plait_param_kind;

/* A field of the struct that a plait_sim_set_<feature> takes, for code that reads, shows or binds
 * them all. Texts are static. Its default is that of the struct's _init. `bdf2` may also be
 * PLAIT_BDF2_OF_MODEL. A slider's range holds the default, except one that stands for off
 * (max_displacement) or that leaves the choice to the library (bdf2, stretch_stiffness,
 * twist_stiffness). */
typedef struct plait_param_info {
    uint32_t struct_size;
    plait_param_kind kind;
    const char* name;           /* "gravity", "grid_edge": as plait_sim_set_param takes it */
    const char* unit;           /* "m/s^2"; "" without one */
    const char* const* choices; /* CHOICE: names of the values 0 to `most`; else NULL */
    uint32_t offset;            /* in the feature's struct, bytes */
    uint32_t count;             /* of components, 4 bytes each */
    double least, most;         /* of each */
    uint32_t least_excluded;    /* 1: greater than `least` */
    uint32_t models;            /* that read it: bit 1u << plait_model */
    const char* text;           /* one sentence: what it does to hair */
    /* "params", "material", "tressfx", "grid", "volume", "strand_contact", "wetness" or
       "acceleration". The name of a field of the last five begins with it: <feature>_<field> */
    const char* feature;
    double default_value[3]; /* of each component; from the fourth on, that of the third; 0 for
                                   components that the field lacks */
    double slider_least;     /* a slider's range for values that suit real hair, the same for */
    double slider_most;      /* each component; it lies within [least, most] */
    uint32_t slider_log;     /* 1: the slider is logarithmic, its least above 0; 0: linear */
} plait_param_info;
PLAIT_STRUCT(plait_param_info)

/* All of them, feature by feature, in the order of its struct: a list. */
PLAIT_API plait_result plait_params_list(plait_param_info* dst, size_t* count);

#ifdef __cplusplus
}
#endif

#endif
