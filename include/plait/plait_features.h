/* What hair may feel beside gravity, the head and bodies. C99; plait.h includes it.
 *
 * Each feature is off at first. plait_sim_set_<feature>(sim, &desc) turns it on from the next step
 * on, and another call changes it; `desc` NULL turns it off. A call that fails changes nothing. The
 * first use builds kernels and makes buffers: plait_context_prepare builds the kernels before.
 */
#ifndef PLAIT_FEATURES_H
#define PLAIT_FEATURES_H

#include <plait/plait.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- wind --------------------------------------------------------------------------------------- */

/* Air that moves past strands and drags them, each vertex as a slender cylinder with the drag of
 * its Reynolds number: mean velocity, gusts of all of it, and eddies that it carries along. It takes
 * the place of the params' `drag`, which is that of a sim without wind; the velocity that
 * `air_with_head` gives the air adds to it. Formulae: docs/wind.md. */
typedef struct plait_wind_desc {
    uint32_t struct_size;
    float velocity[3]; /* m/s, mean, each [-1e3, 1e3], default 0: still air, which brakes */
    float turbulence;  /* m/s, rms of each component of the eddies' velocity, [0, 1e3], default 0 */
    float scale;       /* m, size of the largest eddies, [1e-3, 1e4], default 0.5 */
    uint32_t octaves;  /* sizes of eddies, each half the one before, [1, 8], default 3 */
    float gain;        /* velocity of an octave over that of the one before, [0, 1], default 0.5 */
    float gusts;       /* rms change of `velocity`, as a share of it, [0, 2], default 0 */
    float gust_period; /* s, [0.01, 1e4], default 2 */
    uint32_t seed;     /* of eddies and gusts */
    float tangential;  /* drag along a strand over that across it, [0, 1], default 0.3 */
    float diameter;    /* m, of a hair, [0, 0.1]; default 0: the mean of the groom's thicknesses
                          that are a hair's, 10 um to 1 mm, or 70 um */
    float air_density; /* kg/m^3, (0, 1e4], default 1.204 */
    float viscosity;   /* kinematic, m^2/s, [0, 1], default 1.516e-5; 0: a drag coefficient of 1 */
    /* 1, the default: hair and colliders, but for sheets (meshes that are two_sided), stop the
       wind, and the air in hair goes along with it; 0: nothing does */
    uint32_t shelter;
    float hairs_per_strand; /* sheltering by a guide, [0, 1e6], default 0: itself and its follows */
} plait_wind_desc;
PLAIT_STRUCT(plait_wind_desc)

/* From the next step on; NULL: none, as at first. Its time and its eddies go on when it is changed,
 * and start anew with plait_sim_reset, or after NULL; snapshots hold them, and a sim without wind
 * leaves them there.
 * @errors INVALID_STATE (model tressfx, whose wind is that of its params) */
PLAIT_API plait_result plait_sim_set_wind(plait_sim* sim, const plait_wind_desc* desc);

/* ---- frame of reference ------------------------------------------------------------------------- */

/* What the air of a frame does, in which the hair's drag and a wind are. */
typedef enum plait_frame_air {
    PLAIT_FRAME_AIR_UNFELT = 0, /* it moves with the part of the frame's motion that is not felt */
    PLAIT_FRAME_AIR_FRAME = 1,  /* it moves with the frame: a closed cabin */
    PLAIT_FRAME_AIR_WORLD = 2,  /* it stands in the world: an open car */
    PLAIT_FRAME_AIR_FORCE_32 = 0x7fffffff
} plait_frame_air;

/* A frame of reference that carries the hair: a vehicle, a lift, a horse, the root of an animation.
 * Hair feels a share of its motion; the rest takes hair, roots and bodies along as if it had not
 * been. */
typedef struct plait_frame_desc {
    uint32_t struct_size;
    plait_pose pose; /* in the world, where it will be at the end of the next plait_sim_step */
    float felt_translation; /* share of its way that hair feels, [0, 1], default 0 */
    float felt_rotation;    /* share of its turn about its origin, likewise, default 0 */
    plait_frame_air air;    /* default UNFELT */
} plait_frame_desc;
PLAIT_STRUCT(plait_frame_desc)

/* Where the frame will be, once per frame, beside plait_sim_set_roots; on the way it interpolates. The
 * first call, also after NULL, a teleport and a step of 0 s put it there at once. Told after a teleport
 * it went along, if that is nearer. NULL: none. Roots, colliders, pins and winds stay places in the
 * world; gravity keeps its direction. With shares of 1 and air UNFELT steps give the bits of no frame;
 * with shares of 0 hair moves as if the frame stood still. Snapshots hold it. */
PLAIT_API plait_result plait_sim_set_frame(plait_sim* sim, const plait_frame_desc* desc);

/* ---- volume ------------------------------------------------------------------------------------- */

/* Hair keeps the room it has in the groom, by a pressure on the voxels of the sim's grid, or of a
 * default one where it has none; it replaces the grid's own braking. docs/volume.md. */
typedef struct plait_volume_desc {
    uint32_t struct_size;
    float share;     /* density to keep, over that at rest, [0, 4], default 1 */
    uint32_t sweeps; /* of the pressure's solve, per fixed step, [1, 64], default 10 */
    float rate;      /* 1/s: hair that is too dense parts no faster, [0, 1e3], default 5 */
    float viscosity; /* 1/s: hair takes on the velocity around it, [0, 1e3], default 5 */
    float cohesion;  /* m^2/s^2: tension that hair bears, over its density, [0, 1e4], default 0 */
} plait_volume_desc;
PLAIT_STRUCT(plait_volume_desc)
/* @errors INVALID_STATE (model tressfx, or the grid is of form SLOTS) */
PLAIT_API plait_result plait_sim_set_volume(plait_sim* sim, const plait_volume_desc* desc);

/* ---- grid between strands ----------------------------------------------------------------------- */

typedef enum plait_grid_form {
    PLAIT_GRID_FORM_SLOTS = 0,
    PLAIT_GRID_FORM_EXACT = 1,
    PLAIT_GRID_FORM_FORCE_32 = 0x7fffffff
} plait_grid_form;
typedef enum plait_slot_hash_rule {
    PLAIT_SLOT_HASH_RULE_THESIS = 0,
    PLAIT_SLOT_HASH_RULE_PCG = 1,
    PLAIT_SLOT_HASH_RULE_FORCE_32 = 0x7fffffff
} plait_slot_hash_rule;
typedef enum plait_tent_form {
    PLAIT_TENT_FORM_VOXEL = 0,
    PLAIT_TENT_FORM_TRILINEAR = 1,
    PLAIT_TENT_FORM_FORCE_32 = 0x7fffffff
} plait_tent_form;
typedef enum plait_diffuse_rule {
    PLAIT_DIFFUSE_RULE_THESIS = 0,
    PLAIT_DIFFUSE_RULE_FLOORED = 1,
    PLAIT_DIFFUSE_RULE_FORCE_32 = 0x7fffffff
} plait_diffuse_rule;

/* The thesis's inter-hair step, once per fixed step: hair that outruns the hair around it is slowed.
 * Both models. See docs/grid.md. */
typedef struct plait_grid_desc {
    uint32_t struct_size;
    plait_grid_form form;            /* default EXACT; SLOTS samples, as the thesis does */
    uint32_t edge_count;             /* voxels along an edge, [1, 64], default 8 */
    uint32_t slot_capacity;          /* of SLOTS, [1, 65536], default 1024 */
    plait_slot_hash_rule slot_hash;  /* of SLOTS, default PCG */
    plait_tent_form tent;            /* default VOXEL (SLOTS is always VOXEL) */
    plait_diffuse_rule diffuse_rule; /* default FLOORED */
    float diffuse_ratio;             /* [0, 1e6], default 2 */
    float diffuse_factor;            /* [0, 1], default 0.9 */
    float diffuse_floor;             /* [0, 1], default 0.5 */
    uint32_t in_world;               /* 0: moves and turns with the head; 1: fixed in the world */
    float origin[3]; /* corner, m, each [-1e6, 1e6], where edge > 0; of world or head */
    float edge;      /* whole edge, m, [0, 1e6]; 0: a cube around the groom's bounds x 1.5 */
} plait_grid_desc;
PLAIT_STRUCT(plait_grid_desc)
PLAIT_API plait_result plait_sim_set_grid(plait_sim* sim, const plait_grid_desc* desc);

/* ---- strand contact ----------------------------------------------------------------------------- */

/* Guide strands meet each other. docs/strand_contact.md. */
typedef struct plait_strand_contact_desc {
    uint32_t struct_size;
    float radius;   /* m, (0, 0.1], default 0.002: half the distance of guides */
    float friction; /* Coulomb coefficient, [0, 10], default 0.3 */
} plait_strand_contact_desc;
PLAIT_STRUCT(plait_strand_contact_desc)
/* @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_strand_contact(plait_sim* sim,
                                                    const plait_strand_contact_desc* desc);

/* ---- wetness ------------------------------------------------------------------------------------ */

/* Hair gets wet where PLAIT_FIELD_WETNESS is written, and dries. NULL: all of it is dry at once.
 * docs/wetness.md. */
typedef struct plait_wetness_desc {
    uint32_t struct_size;
    float drying_time; /* tau, s: wetness falls with e^(-t/tau), [0, 1e9], default 0: it stays */
    float cohesion;    /* m^2/s^2, with volume: cohesion of wetness 1, [0, 1e4], default 0.03 */
} plait_wetness_desc;
PLAIT_STRUCT(plait_wetness_desc)
/* @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_wetness(plait_sim* sim, const plait_wetness_desc* desc);

/* ---- pins --------------------------------------------------------------------------------------- */

/* What plait_sim_set_pins holds vertices at. */
typedef enum plait_pin_frame {
    PLAIT_PIN_FRAME_REST = 0,  /* where the groom has the vertex, carried by its strand's root */
    PLAIT_PIN_FRAME_GROOM = 1, /* `target`, a place in the groom, carried likewise */
    PLAIT_PIN_FRAME_WORLD = 2, /* `target`, in the world */
    PLAIT_PIN_FRAME_FORCE_32 = 0x7fffffff
} plait_pin_frame;

/* N/m: more than any strand takes, so that a vertex is held as fast as can be. */
#define PLAIT_PIN_HELD 1e6f

/* A spring from a vertex to a point, the same in every direction: a hair tie or a clip (REST, with
 * nothing to do per frame), the end of a rope, a hand (WORLD). See docs/pins.md. */
typedef struct plait_pin {
    uint32_t strand;       /* a guide */
    uint32_t vertex;       /* 1 to its last; 0, the root, its pose holds. 1 alone does not clamp */
    plait_pin_frame frame; /* REST */
    float target[3];       /* m, each [-1e6, 1e6]; REST reads none. Of GROOM at the groom's size */
    /* N/m, (0, 1e6]. Clamped to max(1e4 m/s^2 M/l, 100 m/h'^2), and so that the force stays below
       300 m/s^2 M: M the strand's mass, l the segment before the vertex, m the vertex's mass, h'
       the substep (BDF2: 2/3 of it) */
    float stiffness;
} plait_pin;

/* All pins of a sim, `count` of them, in place of those before; 0: none. The target of a vertex
 * that was pinned before moves straight to where it is now in the next plait_sim_step, as roots do;
 * others are there at once. The vertex feels stiffness x (target - x), the tension in the tie
 * unless the clamp limits it. Pins stay until they are set or written again, over reset and
 * teleport (what is in the world stays there); snapshots hold them. The first call waits.
 * @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_pins(plait_sim* sim, const plait_pin* pins, size_t count);

/* ---- acceleration ------------------------------------------------------------------------------- */

/* Vertices are accelerated by PLAIT_FIELD_ACCELERATION, which the caller writes, or the caller's
 * kernel for the stage accelerate before each fixed step. Both models. docs/backends.md. */
typedef struct plait_acceleration_desc {
    uint32_t struct_size;
    float values[16]; /* each [-1e6, 1e6], default 0: passed to that kernel, which defines them */
} plait_acceleration_desc;
PLAIT_STRUCT(plait_acceleration_desc)
PLAIT_API plait_result plait_sim_set_acceleration(plait_sim* sim,
                                                  const plait_acceleration_desc* desc);
/* ---- detail of follows -------------------------------------------------------------------------- */

/* What follow strands get after the simulation, each by a ramp over its length: knots at the root,
 * a third, two thirds and the tip, linear between. First strands are drawn to the centres of their
 * clumps, turned and as long as they are; then come curl and frizz, as offsets in a frame that each
 * strand carries along, which lengthen it. Guides and roots stay. See docs/follows.md. */
typedef struct plait_detail_desc {
    uint32_t struct_size;
    float clump[4];     /* share of the way to the centre, each [0, 1], default 0 */
    float curl[4];      /* m, radius of the curls, each [0, 1], default 0 */
    float curl_pitch;   /* m of hair per turn, [1e-4, 100], default 0.02 */
    float curl_scatter; /* share of a turn by which curls of one clump differ, [0, 1], default 1 */
    float frizz[4];     /* m, rms in each of two directions, each [0, 1], default 0 */
    float frizz_length; /* m of hair over which it keeps its direction, [1e-4, 100], default 0.01 */
    uint32_t seed;      /* of clumps, phases and frizz */
    uint32_t clumps;    /* number of centres, follows whose roots are spread evenly, [0, follows];
                           default 0: one for each guide */
    /* uint32_t [follows] or empty: the strand each is drawn to, in place of `clumps`, which must be
       0: a guide, or a follow that is its own centre */
    plait_view clump_centres;
} plait_detail_desc;
PLAIT_STRUCT(plait_detail_desc)

/* From the next step or reset on, which shows positions; NULL: none, as at first. In every model;
 * not part of a snapshot. Waits.
 * @errors INVALID_STATE (no follows) */
PLAIT_API plait_result plait_sim_set_detail(plait_sim* sim, const plait_detail_desc* desc);

/* ---- TressFX ------------------------------------------------------------------------------------ */

/* Forms of a formula: PUBLISHED and THRESHOLD as in TressFX 4, THESIS as in Ugurca 2015; the others
 * are our corrections. What each corrects: docs/models/tressfx.md. */
typedef enum plait_wind_form {
    PLAIT_WIND_FORM_PUBLISHED = 0,
    PLAIT_WIND_FORM_DRAG = 1,
    PLAIT_WIND_FORM_FORCE_32 = 0x7fffffff
} plait_wind_form;
typedef enum plait_shock_form {
    PLAIT_SHOCK_FORM_THRESHOLD = 0,
    PLAIT_SHOCK_FORM_CONTINUOUS = 1,
    PLAIT_SHOCK_FORM_FORCE_32 = 0x7fffffff
} plait_shock_form;
typedef enum plait_stage_order {
    PLAIT_STAGE_ORDER_PUBLISHED = 0,
    PLAIT_STAGE_ORDER_SHOCK_BEFORE_GLOBAL = 1,
    PLAIT_STAGE_ORDER_FORCE_32 = 0x7fffffff
} plait_stage_order;

/* TressFX's own parameters, of a sim of model tressfx alone; `desc` NULL: the defaults. See
 * docs/tressfx.md. */
typedef struct plait_tressfx_desc {
    uint32_t struct_size;
    float damping;               /* [0, 100], default 0.08 */
    float local_stiffness;       /* [0, 1], default 0.9 */
    uint32_t local_iterations;   /* [0, 64], default 2 */
    float global_stiffness;      /* [0, 1], default 0 */
    float global_range;          /* [0, 1], default 0 */
    uint32_t length_iterations;  /* [0, 256], default 2 */
    float vsp_coeff;             /* [0, 1], default 0.8 */
    float vsp_accel_threshold;   /* m, [0, 1e6], default 1.4 */
    float max_displacement;      /* clamp per substep, m, (0, 1e6], default 1e6: off */
    float attachment;            /* largest distance from the root over arc length, [0, 100],
                                    default 0: off; 1: the strand as a whole does not stretch */
    float wind[3];               /* m/s, each [-1e3, 1e3], default 0 */
    float air_drag;              /* rho_air C_d d / (2 rho A), 1/m, [0, 1e6], default 0 */
    float wind_cone;             /* published form: its half angle, rad, [0, pi/2], default 0.7 */
    plait_wind_form wind_form;   /* default DRAG */
    plait_shock_form shock_form; /* default THRESHOLD */
    plait_stage_order order;     /* default PUBLISHED */
} plait_tressfx_desc;
PLAIT_STRUCT(plait_tressfx_desc)
/* @errors INVALID_STATE (model articulated) */
PLAIT_API plait_result plait_sim_set_tressfx(plait_sim* sim, const plait_tressfx_desc* desc);

/* ---- kernels before the first frame --------------------------------------------------------- */

/* What sims use that not every sim does. Every sim may reset, teleport, read, write and measure,
 * interpolate its output, and meet capsules, planes, boxes and hulls. */
typedef enum plait_feature {
    PLAIT_FEATURE_SWITCHES = 1,        /* plait_sim_set_settings */
    PLAIT_FEATURE_SKIN = 2,            /* plait_roots.bones */
    PLAIT_FEATURE_BOUND_ROOTS = 4,     /* plait_sim_bind_roots */
    PLAIT_FEATURE_FRAME = 8,           /* plait_sim_set_frame */
    PLAIT_FEATURE_MESHES = 16,         /* plait_collider_create_mesh, form FIELD */
    PLAIT_FEATURE_BENDING_MESHES = 32, /* the same, form NEAREST */
    PLAIT_FEATURE_PINS = 64,           /* plait_sim_set_pins */
    PLAIT_FEATURE_GROOM = 128,         /* plait_sim_params.groom, plait_material.groom_stiffness */
    PLAIT_FEATURE_ACCELERATION = 256,  /* plait_sim_set_acceleration */
    PLAIT_FEATURE_WIND = 512,          /* plait_sim_set_wind; of tressfx, that of its desc */
    PLAIT_FEATURE_GRID = 1024,         /* plait_sim_set_grid, form EXACT */
    PLAIT_FEATURE_SLOTS = 2048,        /* the same, SLOTS */
    PLAIT_FEATURE_VOLUME = 4096,       /* plait_sim_set_volume */
    PLAIT_FEATURE_STRAND_CONTACT = 8192, /* plait_sim_set_strand_contact */
    PLAIT_FEATURE_FOLLOWS = 16384,       /* plait_sim_desc.follow_map, follows_per_guide */
    PLAIT_FEATURE_DETAIL = 32768,        /* plait_sim_set_detail */
    PLAIT_FEATURE_WETNESS = 65536,       /* plait_sim_set_wetness */
    PLAIT_FEATURE_ALL = 131071,
    PLAIT_FEATURE_FORCE_32 = 0x7fffffff
} plait_feature;

/* Called before each stage that is built, `done` of `total` of them before it, and once at the end
 * with done == total and stage "". It calls nothing of plait. 0: go on; any other value ends the
 * call. `stage` is valid until it returns. */
typedef int (*plait_progress_fn)(uint32_t done, uint32_t total, const char* stage, void* user);

typedef struct plait_prepare_desc {
    uint32_t struct_size;
    uint32_t models;   /* of the sims: bits 1u << plait_model; default ARTICULATED's */
    uint32_t features; /* bits of plait_feature, default 0; the skin of `groom` is among them */
    uint32_t vertices_per_strand; /* V, [2, 256]; default 0: of `groom`, or 16 where that is NULL */
    /* The hair: kernels are built for its strands' lengths and number. NULL: for 2,048 strands of
       vertices_per_strand; where a driver tells these from many (PoCL: from 65,536 vertices on), a
       sim builds some kernels again */
    const plait_groom* groom;
    plait_progress_fn progress; /* or NULL */
    void* progress_user;
} plait_prepare_desc;
PLAIT_STRUCT(plait_prepare_desc)

/* Builds the kernels of sims ahead, for a loading screen; it takes seconds where nothing is cached.
 * Sims that use no more than `desc` names, with grids of at most 32 voxels along an edge, then
 * compile nothing. `desc` NULL: all defaults. Calls for several grooms add up. Meanwhile other
 * threads may use all but this context and its sims. Kernels that are built stay where it ends early;
 * the next call goes on from them. Waits.
 * @errors CANCELLED (by `progress`) */
PLAIT_API plait_result plait_context_prepare(plait_context* context,
                                             const plait_prepare_desc* desc);

#ifdef __cplusplus
}
#endif

#endif
