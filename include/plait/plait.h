/* plait: real-time hair simulation on any OpenCL device. C99.
 *
 * A `plait_context` is a device; a `plait_groom` is immutable hair at rest; a `plait_sim` is one
 * groom moving on one context. SI units, right-handed axes, quaternions stored (x, y, z, w). A pose
 * maps a rest-space point p to q*p + t in the world. docs/concepts.md shows the calls of a frame.
 *
 * Headers:   this one includes plait_features.h, wind, volume and others, and plait_mesh.h, bodies
 *            and scalps. plait_offline.h has tools without a context, plait_presets.h kinds of hair,
 *            plait_recorder.h and plait_formats.h files; plait_async.h does not wait, plait_profile.h
 *            measures; plait_opencl.h, plait_backend.h and plait_cluster.h are for devices.
 * Errors:    every function that can fail returns a plait_result and leaves a sentence that names
 *            what failed, on what, with which value and range, in plait_last_error() of the thread.
 *            A call that fails leaves objects and outputs as they were, unless its comment says
 *            otherwise or the device failed on the way. Every function may return INVALID_ARGUMENT
 *            (for NULL, unless the parameter is documented as optional, or for a value out of
 *            range), OUT_OF_MEMORY and, where work reaches a device, DEVICE_LOST and BACKEND. One
 *            that needs a stage may return UNSUPPORTED (the backend lacks it) and COMPILE.
 *            `@errors` lists the others.
 * Lists:     dst == NULL writes the needed count to *count; otherwise at most *count elements are
 *            written and *count becomes their number. The caller initialises elements that have a
 *            struct_size. Of bytes (fields, snapshots) *size is the count: one that is too small
 *            is INVALID_ARGUMENT, and 0 are needed where the object lacks the field.
 * Threads:   a context and what it made are used by one thread at a time; different contexts are
 *            independent. Grooms, follow maps and meshes are immutable and may be shared by threads
 *            and contexts. Callbacks run on the thread that makes the call, and must not call plait
 *            on the same context.
 * Waiting:   a function that says "Waits" waits for the device. Others do not, but the first use of
 *            a feature may build kernels and make buffers. See docs/threading.md.
 * Ownership: what a function made is released by the `_destroy` of the same noun; destroying NULL
 *            does nothing. Arrays and texts passed in are copied before the call returns. A sim
 *            keeps what it needs of its context, groom, map and meshes, which may be destroyed
 *            before it.
 * Names:     functions are plait_<object>_<verb>_<noun>, without the noun where the verb says all,
 *            and plait_<objects>_list. Values of `enum plait_x_y` are PLAIT_X_Y_<VALUE>, but those
 *            of plait_result PLAIT_<VALUE>. Every enum takes 32 bits (its _FORCE_32).
 * Structs:   begin with struct_size; initialise all of them, outputs included, with their
 *            `plait_*_init` (or by value, `plait_*_defaults`) and then change fields. Fields that a
 *            shorter struct lacks (an older plait.h) have their defaults. If a struct is longer
 *            than this library knows (a newer plait.h), the extra bytes must be zero; otherwise
 *            the call fails. None is longer than PLAIT_STRUCT_SIZE_MAX.
 * Formulae:  docs/stages and docs/models, with papers and equations.
 */
#ifndef PLAIT_H
#define PLAIT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(PLAIT_STATIC)
#define PLAIT_API
#elif defined(_WIN32)
#ifdef PLAIT_BUILD
#define PLAIT_API __declspec(dllexport)
#else
#define PLAIT_API __declspec(dllimport)
#endif
#else
#define PLAIT_API __attribute__((visibility("default")))
#endif

#define PLAIT_VERSION_MAJOR 0
#define PLAIT_VERSION_MINOR 2
#define PLAIT_VERSION_PATCH 0
/* Of this header; plait_version() is that of the library that is linked. */
#define PLAIT_VERSION_NUMBER                                                                       \
    (PLAIT_VERSION_MAJOR * 10000 + PLAIT_VERSION_MINOR * 100 + PLAIT_VERSION_PATCH)

/* Bytes, of any struct in any version: a struct_size beyond is one that was not initialised. */
#define PLAIT_STRUCT_SIZE_MAX 4096
/* Of each struct: `plait_x_init(&x, sizeof x)` sets the defaults, `plait_x_defaults()` returns them
 * by value. */
#define PLAIT_STRUCT(type)                                                                         \
    PLAIT_API void type##_init(type* value, size_t size);                                          \
    static inline type type##_defaults(void) {                                                     \
        type value;                                                                                \
        type##_init(&value, sizeof value);                                                         \
        return value;                                                                              \
    }

/* ---- results -------------------------------------------------------------------------------- */

/* What the caller can do about it; the message says what happened. */
#define PLAIT_RESULTS(X)                                                                           \
    X(OK, 0, "ok")                                                                                 \
    X(INVALID_ARGUMENT, 1, "an argument is outside its allowed range")                             \
    X(INVALID_STATE, 2, "the object cannot do this now")                                           \
    X(OUT_OF_MEMORY, 3, "host or device memory is exhausted")                                      \
    X(NOT_FOUND, 4, "no such file, device, backend or name")                                       \
    X(IO, 5, "reading or writing a file failed")                                                   \
    X(BAD_DATA, 6, "the data is malformed")                                                        \
    X(UNSUPPORTED, 7, "the backend or format cannot do this")                                      \
    X(COMPILE, 8, "a kernel did not build; the message holds the compiler's log")                  \
    X(DEVICE_LOST, 9, "the device is gone; destroy the context")                                   \
    X(BACKEND, 10, "a driver call failed")                                                         \
    X(INTERNAL, 11, "a fault in plait; please report it")                                          \
    X(CANCELLED, 12, "a function of the caller's ended it")

typedef enum plait_result {
#define PLAIT_X(name, value, text) PLAIT_##name = value,
    PLAIT_RESULTS(PLAIT_X)
#undef PLAIT_X
        PLAIT_RESULT_FORCE_32 = 0x7fffffff
} plait_result;

/* The text in PLAIT_RESULTS; static storage, never NULL. */
PLAIT_API const char* plait_result_string(plait_result result);

/* The sentence of this thread's last failed call; "" if none. Valid until its next failure. */
PLAIT_API const char* plait_last_error(void);

/* PLAIT_VERSION_NUMBER of the library that is linked. */
PLAIT_API uint32_t plait_version(void);

/* ---- small types ---------------------------------------------------------------------------- */

typedef struct plait_context plait_context;
typedef struct plait_groom plait_groom;
typedef struct plait_follow_map plait_follow_map;
typedef struct plait_mesh plait_mesh;
typedef struct plait_sim plait_sim;

/* An input array: `count` elements, `stride` bytes apart (0: tightly packed). */
typedef struct plait_view {
    const void* data;
    size_t count;
    size_t stride;
} plait_view;

/* Rotation (unit quaternion x, y, z, w) and translation in metres. */
typedef struct plait_pose {
    float q[4];
    float t[3];
} plait_pose;

typedef enum plait_log_level {
    PLAIT_LOG_LEVEL_DEBUG = 0,
    PLAIT_LOG_LEVEL_INFO = 1,
    PLAIT_LOG_LEVEL_WARNING = 2,
    PLAIT_LOG_LEVEL_ERROR = 3,
    PLAIT_LOG_LEVEL_FORCE_32 = 0x7fffffff
} plait_log_level;

/* `text` has no newline at its end, and is valid until the function returns. */
typedef void (*plait_log_fn)(plait_log_level level, const char* text, void* user);

/* Host allocator for plait's own arrays. Both or neither of the functions are set. `allocate` may
 * return NULL: the call then fails with PLAIT_OUT_OF_MEMORY and leaves its objects as they were. */
typedef struct plait_allocator {
    void* (*allocate)(size_t size, size_t alignment, void* user);
    void (*release)(void* memory, size_t size, size_t alignment, void* user);
    void* user;
} plait_allocator;

/* ---- devices and contexts ------------------------------------------------------------------- */

typedef enum plait_device_type {
    PLAIT_DEVICE_TYPE_CPU = 0,
    PLAIT_DEVICE_TYPE_GPU = 1,
    PLAIT_DEVICE_TYPE_OTHER = 2,
    PLAIT_DEVICE_TYPE_FORCE_32 = 0x7fffffff
} plait_device_type;

typedef struct plait_device_info {
    uint32_t struct_size;
    char backend[32];  /* "opencl", "reference", or a registered backend */
    char platform[96]; /* "Portable Computing Language" */
    char name[96];
    char vendor[64];
    char driver[96];
    plait_device_type type;
    uint32_t compute_units;
    uint64_t memory_bytes;   /* 0: unknown */
    uint32_t float_width;    /* native vector width in floats, 1 on GPUs */
    uint32_t lanes;          /* strands a work-item of articulated steps at once: 1, 4, 8, 16 */
    uint32_t tile;           /* strands per tile of the lane layout, a multiple of lanes */
    uint32_t max_group_size; /* work-items per work-group */
    uint64_t local_memory_bytes;
} plait_device_info;
PLAIT_STRUCT(plait_device_info)

/* Every device of every registered backend, best first: a list. No device is no error. */
PLAIT_API plait_result plait_devices_list(plait_device_info* dst, size_t* count);

/* The user's own kernel for one stage, checked against the stage's signature when the context is
 * made. See docs/backends.md. */
typedef struct plait_stage_source {
    const char* stage;  /* "tressfx_wind" */
    const char* source; /* OpenCL C, defines plait_<stage>; may include those of cl/base */
    const char* name;   /* file name for the compiler's messages; NULL: "<stage>" */
} plait_stage_source;

/* `log_user` and what the allocator names must outlive the context and its sims. */
typedef struct plait_context_desc {
    uint32_t struct_size;
    const char* backend; /* NULL: the best there is */
    const char* device;  /* words of a device's, vendor's, platform's name, cpu, gpu; NULL: best */
    plait_log_fn log;    /* NULL: silent */
    void* log_user;
    plait_allocator allocator;
    uint32_t profile; /* 1: time every stage (a few percent slower), see plait_profile.h */
    const plait_stage_source* stage_sources;
    size_t stage_source_count;
    uint32_t lanes; /* strands per work-item in articulated: 1, 4, 8, 16; 0: the device's */
    /* Folder, created if missing, that keeps built kernels for later processes, one file each; a
       file that is damaged or of another driver is rebuilt and replaced. NULL: kernels live as long
       as a context of the device in this process */
    const char* program_folder;
} plait_context_desc;
PLAIT_STRUCT(plait_context_desc)

/* `desc` NULL: all defaults. Contexts of one device share built kernels within the process, on any
 * threads, except those of plait_opencl_context_create, which build in the caller's OpenCL context.
 * @errors NOT_FOUND (no such device; the message lists those there are), COMPILE (stage_sources),
 *         IO (program_folder) */
PLAIT_API plait_result plait_context_create(const plait_context_desc* desc, plait_context** out);
/* Its sims stay valid; its device and memory are released with the last of them. */
PLAIT_API void plait_context_destroy(plait_context* context);
/* The device it is on, and its `lanes`. */
PLAIT_API plait_result plait_context_describe(const plait_context* context, plait_device_info* out);

/* ---- grooms --------------------------------------------------------------------------------- */

/* What to do with strands that cannot be simulated as they are. Nothing is repaired silently. */
typedef enum plait_repair_policy {
    PLAIT_REPAIR_POLICY_REPAIR = 0, /* repair, count, report the first offender */
    PLAIT_REPAIR_POLICY_REFUSE = 1, /* fail with BAD_DATA at the first offender */
    PLAIT_REPAIR_POLICY_FORCE_32 = 0x7fffffff
} plait_repair_policy;

typedef enum plait_repair {
    PLAIT_REPAIR_NONFINITE = 0,      /* position NaN, Inf or beyond 1e6 m: the strand is dropped */
    PLAIT_REPAIR_SHORT_STRAND = 1,   /* fewer than two vertices, or no length (1e-6 m): dropped */
    PLAIT_REPAIR_ZERO_SEGMENT = 2,   /* zero-length segment: the vertex is moved along the strand */
    PLAIT_REPAIR_TINY_SEGMENT = 3,   /* shorter than min_segment of the strand's mean: likewise */
    PLAIT_REPAIR_DUPLICATE_ROOT = 4, /* same root position as an earlier strand: kept, counted */
    PLAIT_REPAIR_TOO_LONG = 5,       /* more than 256 vertices: resampled by arc length */
    PLAIT_REPAIR_COUNT = 6,
    PLAIT_REPAIR_FORCE_32 = 0x7fffffff
} plait_repair;

/* The axes of what is read: where its (x, y, z) comes to lie, here where y is up. Those of
 * left-handed programs are reflected, as such programs show them. */
typedef enum plait_axes {
    PLAIT_AXES_Y_UP = 0,             /* (x, y, z): Maya, Houdini, glTF */
    PLAIT_AXES_Z_UP = 1,             /* (x, z, -y): Blender, 3ds Max */
    PLAIT_AXES_Y_UP_LEFT_HANDED = 2, /* (x, y, -z): Unity */
    PLAIT_AXES_Z_UP_LEFT_HANDED = 3, /* (x, z, y): Unreal Engine */
    PLAIT_AXES_FORCE_32 = 0x7fffffff
} plait_axes;

/* Which end of a strand is its root. */
typedef enum plait_root_end {
    PLAIT_ROOT_END_FIRST = 0, /* the first vertex of each */
    PLAIT_ROOT_END_LAST = 1,  /* the last: strands are stored from tip to root */
    /* the last of strands that would count as roots_contradicted, else the first */
    PLAIT_ROOT_END_AGREED = 2,
    PLAIT_ROOT_END_FORCE_32 = 0x7fffffff
} plait_root_end;

typedef struct plait_import_options {
    uint32_t struct_size;
    plait_repair_policy policy;
    float min_segment; /* tiny: below this share of the strand's mean, [0, 0.5], default 1e-3 */
    float scale;       /* units of what is read to metres, (0, 1e6], default 1 */
    uint32_t resample; /* 0: keep; 2..256: every strand to this many vertices by arc length */
    plait_allocator allocator;
    plait_axes axes;         /* default Y_UP */
    plait_root_end root_end; /* default FIRST */
    plait_pose pose;         /* after axes and scale: a turn, then an offset in m, each
                                [-1e6, 1e6]; default the identity */
} plait_import_options;
PLAIT_STRUCT(plait_import_options)

typedef struct plait_groom_desc {
    uint32_t struct_size;
    plait_view positions;     /* float[3], metres, strand after strand, root first [vertices] */
    plait_view vertex_counts; /* uint32_t [strands]; or empty: all have vertices_per_strand */
    uint32_t vertices_per_strand;
    plait_view strand_uv;    /* float[2] [strands] or empty */
    plait_view thickness;    /* float, strand diameter in metres [strands] or empty */
    plait_view bone_indices; /* uint32_t[4] [strands] or empty */
    plait_view bone_weights; /* float[4] [strands] or empty, sum 1 */
} plait_groom_desc;
PLAIT_STRUCT(plait_groom_desc)

/* `options` NULL: defaults. @errors BAD_DATA (nothing left, or policy REFUSE) */
PLAIT_API plait_result plait_groom_create(const plait_groom_desc* desc,
                                          const plait_import_options* options, plait_groom** out);

/* By extension: .abc, .usda, .tfx (a .tfxbone beside it is read as skin), .hair, .obj polylines, .ply,
 * .data: docs/formats.md. On Windows all paths are UTF-8.
 * @errors NOT_FOUND, IO, BAD_DATA (file, place, value, range), UNSUPPORTED (unknown extension) */
PLAIT_API plait_result plait_groom_load(const char* path, const plait_import_options* options,
                                        plait_groom** out);

/* By extension: .abc, .usda, .hair or .tfx (version 4; strands must have equal vertex counts). The
 * file appears whole or not at all. @errors IO, UNSUPPORTED */
PLAIT_API plait_result plait_groom_save(const plait_groom* groom, const char* path);
PLAIT_API void plait_groom_destroy(plait_groom* groom);

typedef struct plait_groom_info {
    uint32_t struct_size;
    uint64_t strands;
    uint64_t vertices;     /* all strands together */
    uint32_t min_vertices; /* per strand */
    uint32_t max_vertices;
    uint32_t has_strand_uv;
    uint32_t has_thickness;
    uint32_t bones;      /* highest bone index + 1; 0: no skin */
    float bounds_min[3]; /* m */
    float bounds_max[3];
    float min_length; /* m, of a strand */
    float mean_length;
    float max_length;
    /* A guess: the plait_import_options.scale, on top of the one given, with which mean_length is
       that of hair, 5 mm to 2 m, and the longest edge of the bounds 10 m at most: 0.01 for a groom
       in centimetres, 1 for one in metres */
    float likely_scale;
    uint64_t repairs[PLAIT_REPAIR_COUNT]; /* strands or segments repaired, by kind */
    uint64_t repairs_total;
    char first_repair[192];      /* "strand 17, vertex 3: segment of 0 m ..." or "" */
    uint64_t roots_contradicted; /* strands likely stored tip first: their tip is among the roots */
    uint64_t thickness_unlikely; /* strands whose diameter is no hair's, 10 um to 1 mm */
    char warning[512];           /* what of this is likely wrong, in sentences; "": nothing */
} plait_groom_info;
PLAIT_STRUCT(plait_groom_info)
PLAIT_API plait_result plait_groom_describe(const plait_groom* groom, plait_groom_info* out);

typedef enum plait_groom_field {
    PLAIT_GROOM_FIELD_POSITIONS = 0,     /* float[3] [vertices] */
    PLAIT_GROOM_FIELD_VERTEX_COUNTS = 1, /* uint32_t [strands] */
    PLAIT_GROOM_FIELD_STRAND_UV = 2,     /* float[2] [strands] */
    PLAIT_GROOM_FIELD_THICKNESS = 3,     /* float [strands] */
    PLAIT_GROOM_FIELD_BONE_INDICES = 4,  /* uint32_t[4] [strands] */
    PLAIT_GROOM_FIELD_BONE_WEIGHTS = 5,  /* float[4] [strands] */
    PLAIT_GROOM_FIELD_GROUP = 6, /* uint32_t [strands]: its file's groom_group_id; or empty */
    PLAIT_GROOM_FIELD_FORCE_32 = 0x7fffffff
} plait_groom_field;

/* After repairs: bytes. */
PLAIT_API plait_result plait_groom_read(const plait_groom* groom, plait_groom_field field,
                                        void* dst, size_t* size);

/* ---- parameters ----------------------------------------------------------------------------- */

typedef enum plait_model {
    PLAIT_MODEL_TRESSFX = 0,     /* parity with TressFX and the thesis; docs/models/tressfx.md */
    PLAIT_MODEL_ARTICULATED = 1, /* inextensible rod; docs/models/articulated.md */
    PLAIT_MODEL_FORCE_32 = 0x7fffffff
} plait_model;

/* How strands of follows_per_guide follow. PUBLISHED: as in TressFX 4. */
typedef enum plait_follow_form {
    PLAIT_FOLLOW_FORM_PUBLISHED = 0,
    PLAIT_FOLLOW_FORM_ROTATING = 1,
    PLAIT_FOLLOW_FORM_FORCE_32 = 0x7fffffff
} plait_follow_form;

/* A value of bdf2: 1 unless strand_contact is on. */
#define PLAIT_BDF2_OF_MODEL 0xffffffffu

/* How hair moves, whatever it is made of and whatever acts on it. Values outside the ranges in
 * brackets are refused, here and in every struct below. */
typedef struct plait_sim_params {
    uint32_t struct_size;
    float gravity[3];              /* m/s^2, default (0, -9.81, 0), each [-1e4, 1e4] */
    uint32_t follow_contact;       /* 1 (default): strands that follow by a map are turned out of
                                colliders, except of meshes that are two_sided; 0: they are not */
    float tip_separation;          /* of follows_per_guide, [0, 100], default 0 */
    plait_follow_form follow_form; /* of follows_per_guide, default ROTATING */

    /* Model articulated reads what follows */
    float drag; /* 1/s, of still air, while the sim has no wind, [0, 1e4], default 2: swings halve
                   in 0.7 s */
    float air_with_head; /* [0, 1], share of the head's velocity that the air has, at the middle of
                            the groom, in a wind, too; 1: under a hat; default 0 */
    float groom; /* [0, 1], default 0: the share of a level strand's droop under its weight that is
                    taken away; 1: hair stays as groomed. docs/groom.md */
    uint32_t iterations; /* Newton steps, [0, 64], default 1; beside a body, 0 is 1 */
    uint32_t bdf2;       /* 0: backward Euler; 1: BDF2; or PLAIT_BDF2_OF_MODEL (default) */
} plait_sim_params;
PLAIT_STRUCT(plait_sim_params)

/* What strands are made of. Ramps have knots at the root, a third, two thirds of the arc length and
 * the tip, linear between. Model articulated; docs/concepts.md. */
typedef struct plait_material {
    uint32_t struct_size;
    float line_density;      /* rho A, kg/m, [1e-9, 1e3], default 5e-6 */
    float bend_stiffness;    /* EI, N m^2, [0, 1e3], default 4.7e-9 (a hair of 70 um at 4 GPa) */
    float stretch_stiffness; /* EA, N, [0, 1e9], default 0: of 1 % stretch under its weight at 10 g.
                                Only kernels of the caller's for the stage articulated read it */
    float twist_stiffness;   /* GJ, N m^2, [0, 1e3], default 0: as bend_stiffness */
    float section_ratio;     /* EI2/EI of an ellipse, [1e-3, 1e3], default 1: round. A strand
                                curls about the axis of bend_stiffness */
    float curl;              /* scale of the turn at rest of every joint but the clamp, [0, 4],
                                default 1: as groomed; 0: straight */
    float clamp_stiffness;   /* scale of what holds the first segment in its direction, [0, 100],
                                default 1; 0: a hinge */
    float stiffness_ramp[4]; /* scale of bend and twist stiffness, each [0, 100], default 1 */
    float density_ramp[4];   /* scale of line_density, each [1e-3, 1e3], default 1 */
    float drag_scale;      /* scale of `drag` of the params and of a wind's, [0, 100], default 1 */
    float friction_scale;  /* scale of friction with colliders and strands, [0, 100], default 1;
                                of two strands each feels its own */
    float groom_stiffness; /* N/m^2, [0, 1e6], default 0: a spring of groom_stiffness x l draws
                                hair of length l to its place in the groom. Adds to that of the
                                params' `groom` */
    float groom_ramp[4];   /* scale of both, each [0, 100], default 1 */
} plait_material;
PLAIT_STRUCT(plait_material)

/* ---- sims ----------------------------------------------------------------------------------- */

/* Whether the groom is the unloaded shape of the strands, from which they sag, or their equilibrium
 * under their weight: with the gravity and material that the sim is made with and the head
 * unrotated. It is found again when the material changes, and by plait_sim_find_balance. */
typedef enum plait_sag_free {
    PLAIT_SAG_FREE_OFF = 0,
    PLAIT_SAG_FREE_REST = 1,    /* joints too weak for the groom keep their stiffness, and sag */
    PLAIT_SAG_FREE_STIFFEN = 2, /* these joints get the stiffness that holds it, stably */
    PLAIT_SAG_FREE_FORCE_32 = 0x7fffffff
} plait_sag_free;

typedef struct plait_sim_desc {
    uint32_t struct_size;
    plait_model model;           /* of every strand; default ARTICULATED */
    float step;                  /* fixed step, s, [1e-5, 1], default 1/60 */
    uint32_t substeps;           /* per fixed step, [1, 1000], default 1 */
    uint32_t max_steps_per_call; /* [1, 1000]; time beyond is dropped and counted, default 8 */
    /* What is shown where a frame ends between two steps. 0: the last step. 1: hair between the
       last two, one step late at most, on the head as it is now. 2, the default: 0 while frames end
       where steps do, and 1 from the first frame on that does not */
    uint32_t interpolate_output;
    uint32_t keep_last_frame;           /* 1: POSITION_LAST_FRAME exists; default 0 */
    uint32_t follows_per_guide;         /* copies beside each guide, [0, 64], default 0 */
    float follow_radius;                /* m, [0, 1], default 0.003 */
    uint64_t seed;                      /* follow offsets and slot hash */
    const plait_follow_map* follow_map; /* or NULL; with it follows_per_guide is 0 */
    plait_view strand_stiffness;        /* float [guides] or empty: factor of bend and twist
                                           stiffness, [0, 1e6] */
    /* [material_count], or NULL: the default one; as plait_sim_set_materials takes them */
    const plait_material* materials;
    size_t material_count;
    plait_view strand_material; /* uint32_t [guides], into `materials`; or empty */
    plait_sag_free sag_free;    /* tressfx refuses it. Default OFF */
    plait_sim_params params;
    const struct plait_levels* levels; /* or NULL, see plait_levels.h: of the groom's strands */
    uint32_t level_top;                /* of these the finest that is ever stepped; default 0 */
} plait_sim_desc;
PLAIT_STRUCT(plait_sim_desc)

/* `desc` NULL: all defaults. Strands are stored [strands][V], V the longest of the groom and its
 * follow map; shorter strands are padded with copies of their tip. Guides, the groom's strands,
 * come first, then follows, guide by guide or as in the map. The head starts at the identity.
 * Waits: the hair is on the device then, at rest. Logs the warnings of groom and sim info, and what
 * is away from its default and not read: parameters of features that are off in the next step.
 * @errors UNSUPPORTED (also tressfx with V beyond the device's work-group) */
PLAIT_API plait_result plait_sim_create(plait_context* context, const plait_groom* groom,
                                        const plait_sim_desc* desc, plait_sim** out);
PLAIT_API void plait_sim_destroy(plait_sim* sim);

/* Sets every vertex to its rest position at the present roots, at rest relative to the head, whose
 * motion it takes on in the next step; clock and accumulator to 0. */
PLAIT_API plait_result plait_sim_reset(plait_sim* sim);

/* What a sim is, what it has done, and the result of its sag-free start: from the host alone. */
typedef struct plait_sim_info {
    uint32_t struct_size;
    plait_model model;
    uint64_t guides;              /* strands that are simulated: those of the groom */
    uint64_t strands;             /* guides and follows */
    uint32_t follows_per_guide;   /* 0 with a follow_map */
    uint32_t vertices_per_strand; /* V, the row length */
    float step;                   /* fixed step, s */
    uint32_t substeps;            /* per fixed step */
    uint64_t steps;               /* fixed steps done */
    uint64_t steps_dropped;       /* beyond max_steps_per_call */
    double time;                  /* s simulated */
    uint64_t device_bytes;        /* buffers of this sim */
    uint32_t colliders;

    /* sag-free start, of guides; zeros (and a stiffening of 1) where it is OFF */
    plait_sag_free sag_free;
    uint64_t sag_joints;       /* that hold a load */
    uint64_t joints_stiffened; /* of these, by STIFFEN */
    uint64_t sag_unreached;    /* strands whose residual is above 1e-4: they sag, or creep */
    uint64_t sag_unstable;     /* strands that cannot stay as groomed: they buckle */
    uint64_t worst_residual_strand;
    uint64_t worst_stiffening_strand;
    /* the worst: missing moment / (weight x length), or missing force / weight; 0.5: a limp, level
       strand */
    float sag_residual;
    float worst_stiffening; /* of a joint: its bend stiffness / the material's; 1: none */
    char warning[512];      /* what is likely wrong with groom, units or material, or a kernel of
                               the caller's left out, as logged at creation and now; "": none */
    float scale;            /* of the roots, their bones' included */
} plait_sim_info;
PLAIT_STRUCT(plait_sim_info)

PLAIT_API plait_result plait_sim_describe(const plait_sim* sim, plait_sim_info* out);

/* From the next step on. Waits where material, sag or BDF2 change. */
PLAIT_API plait_result plait_sim_set_params(plait_sim* sim, const plait_sim_params* params);
PLAIT_API plait_result plait_sim_get_params(const plait_sim* sim, plait_sim_params* params);

/* What guide strands are made of, from the next step on. `strand_material`, uint32_t [guides], says
 * of each which of `materials` it is; empty with one material: all are of it; `count` 0: all are of
 * the default one. strand_stiffness scales these, too. Hair moves on from where it is. The shape at
 * rest stays the groom's, but for `curl`; a sag-free start is found anew, and then curls. Waits.
 * @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_materials(plait_sim* sim, const plait_material* materials,
                                               size_t count, plait_view strand_material);

/* One field of the params, the material or a feature that is on, by its name, for sliders, consoles
 * and bindings: plait_params_list (plait_offline.h) has all names. `values` has each of its
 * components: a FLOAT is rounded to float32, a UINT and a CHOICE are whole numbers. For the rest as
 * the plait_sim_set_ of its struct with this field changed. `dst` is a list.
 * @errors NOT_FOUND (no field has this name), INVALID_STATE (its feature is off, or strands are of
 *         several materials), and those of plait_sim_set_<feature> */
PLAIT_API plait_result plait_sim_set_param(plait_sim* sim, const char* name, const double* values,
                                           size_t count);
PLAIT_API plait_result plait_sim_get_param(const plait_sim* sim, const char* name, double* dst,
                                           size_t* count);

/* Finds the balance of a sag-free groom anew, from the next step on: gravity that
 * plait_sim_set_params changes is felt, and does not move the balance by itself. Hair stays where
 * it is. Not part of a snapshot. Waits. @errors INVALID_STATE (sag_free is OFF) */
PLAIT_API plait_result plait_sim_find_balance(plait_sim* sim);

#define PLAIT_STRAND_SETTINGS_MAX 64

/* A setting's default: as plait_sim_desc and plait_sim_params say, also when these change. */
#define PLAIT_SETTING_OF_SIM 0xfffffffeu

/* How a strand is solved. */
typedef struct plait_strand_settings {
    uint32_t struct_size;
    uint32_t substeps;   /* per fixed step, [1, 1000] */
    uint32_t iterations; /* of a substep, [0, 64] */
    uint32_t bdf2;       /* 0, 1, or PLAIT_BDF2_OF_MODEL */
} plait_strand_settings;
PLAIT_STRUCT(plait_strand_settings)

/* The settings of every guide strand, from the next step on: `strand_settings`, uint32_t [guides],
 * are indices into `settings`, [1, PLAIT_STRAND_SETTINGS_MAX]; an empty view: settings[0] for all.
 * Positions and velocities stay, as the settings do over plait_sim_reset and set_params; snapshots
 * hold them. The inter-hair step, ACCELERATION and what the caller reads and writes (VELOCITY,
 * POSITION_PREV) belong to the sim's own substeps. Waits. See docs/settings.md.
 * @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_settings(plait_sim* sim, const plait_strand_settings* settings,
                                              size_t count, plait_view strand_settings);
/* Of every guide strand: a list, but *count below the guides' is INVALID_ARGUMENT. `substeps` is a
 * number, the sim's where it was not set. */
PLAIT_API plait_result plait_sim_get_settings(const plait_sim* sim, plait_strand_settings* dst,
                                              size_t* count);

/* ---- roots ---------------------------------------------------------------------------------- */

/* Where the roots will be at the end of the next plait_sim_step; on the way they interpolate. At
 * most one of root_poses, bones and mesh_positions is given; `head` moves what it gives. */
typedef struct plait_roots {
    uint32_t struct_size;
    plait_pose head;
    plait_view root_poses; /* plait_pose [guides], or empty */
    plait_view bones;      /* float[12], 3x4 row-major skinning matrices [bones], or empty: by the
                              groom's skin, the closest rotation of the blend, on the device */
    plait_view mesh_positions; /* float[3], m, each [-1e6, 1e6], or empty: vertices of the mesh that
                                  plait_sim_bind_roots bound the roots to */
    /* How many times as large as the groom hair is, [1e-3, 1e3], default 1, on top of the scale
       that all bones have; the product has the same range. Places stay metres of the world: head,
       root_poses, the bones' translations, mesh_positions. Neither it nor a bone may mirror */
    float scale;
} plait_roots;
PLAIT_STRUCT(plait_roots)

/* The first call says where the hair is, unless time has passed or velocities were written before;
 * each later one says where it goes. On a head that moves from the start hair takes on the head's
 * velocity in the first step that has two places to tell it from; below 0.9 m/s the head is taken
 * to start from rest. The log warns once of a jump that no head makes.
 *
 * Refused are other counts than the guides' and fewer bones than the skin's, rotations whose length
 * is not 1 within 1e-3, translations beyond 1e6 m, bones that are not finite, map to a line or
 * mirror, and mesh_positions that do so where hair grows.
 *
 * A new scale holds at once: hair, bodies, grids and eddies stay as they were, seen from the head
 * and in its size, and POSITION is as large from the next time on that it is shown. Roots with
 * places of their own keep these around their middle, and the change waits for the device. The
 * scale of bones is the median of the cube roots of their determinants, to 1 part in 65536; the log
 * warns once of a bone whose own differs by more than 1 %, or along its axes. docs/character.md
 * says what is kept. */
PLAIT_API plait_result plait_sim_set_roots(plait_sim* sim, const plait_roots* roots);

/* Carries the hair rigidly to new roots, and to their scale, at once, without dynamics. Hair keeps
 * its motion relative to the head. It feels nothing if the head moves on as before, turned by the
 * teleport; if the head's velocity in the next step differs by 0.9 m/s or more, hair takes on the
 * new one. Colliders are at once where their poses were last set: set those that go along first. A
 * fixed step begins: a part of one that waits is left out. `roots`: as in plait_sim_set_roots. */
PLAIT_API plait_result plait_sim_teleport(plait_sim* sim, const plait_roots* roots);

/* ---- time ----------------------------------------------------------------------------------- */

/* Advances by dt seconds, [0, 1e9]: enqueues the fixed steps that fit; the rest is kept for the
 * next call. Time beyond max_steps_per_call is dropped and counted (plait_sim_info.steps_dropped):
 * hair is carried along with its head over it. A dt below 0 by less than a microsecond is taken as
 * 0. A step of 0 s takes hair along with a head that was moved meanwhile, as plait_sim_teleport
 * does. Failures of the device may come with a later call, at the latest with one that waits. */
PLAIT_API plait_result plait_sim_step(plait_sim* sim, double dt);

/* plait_sim_step for `count` sims of `context`, to the same bits, but put on the device together,
 * where the work of one fills what another leaves idle: for crowds of small sims. With profile = 1
 * one runs after another. A sim that is NULL, of another context or there twice is named by its
 * index, and no sim has moved. Where the device fails the message names the sim it was at: those
 * before it have been stepped, those after it have not. */
PLAIT_API plait_result plait_context_step(plait_context* context, plait_sim* const* sims,
                                          size_t count, double dt);

/* Waits, and reports failures of the steps before. */
PLAIT_API plait_result plait_sim_wait(plait_sim* sim);

/* ---- colliders ------------------------------------------------------------------------------ */

/* Generational id of a collider inside its sim; zero is null. An id that is not of this sim, or
 * whose collider was destroyed, is NOT_FOUND in every function. */
typedef struct plait_collider_id {
    uint64_t value;
} plait_collider_id;

typedef enum plait_collider_kind {
    PLAIT_COLLIDER_KIND_CAPSULE = 0, /* tapered: the hull of two spheres */
    PLAIT_COLLIDER_KIND_PLANE = 1,   /* all that lies under a plane */
    PLAIT_COLLIDER_KIND_BOX = 2,     /* with rounded edges */
    /* made by plait_collider_create_mesh and plait_collider_create_hull; refused by
       plait_collider_create */
    PLAIT_COLLIDER_KIND_MESH = 3,
    PLAIT_COLLIDER_KIND_HULL = 4, /* all that lies under each of its faces */
    PLAIT_COLLIDER_KIND_FORCE_32 = 0x7fffffff
} plait_collider_kind;

/* Shapes, in the collider's own frame, m. */

/* Tapered: the hull of two spheres; a == b: a sphere. */
typedef struct plait_capsule {
    float a[3];     /* one end, each [-1e6, 1e6] */
    float b[3];     /* the other */
    float radius_a; /* at a, (0, 1e3] */
    float radius_b; /* at b, the same */
} plait_capsule;

/* All that lies under it. */
typedef struct plait_plane {
    float point[3];  /* on it, each [-1e6, 1e6] */
    float normal[3]; /* outward, where hair may be; each [-1e6, 1e6], of length [1e-6, 2e6] */
} plait_plane;

/* All that lies within `rounding` of the box of these half extents. */
typedef struct plait_box {
    float centre[3]; /* each [-1e6, 1e6] */
    float
        half_extents[3]; /* half its edges before it is rounded, [0, 1e3]; 0 in all three: a sphere,
                              in two: a capsule */
    float rounding;      /* [0, 1e3] */
    float orientation[4]; /* a unit quaternion, x y z w, from its edges to the own frame */
} plait_box;

/* What hair stays out of: of the shape of its kind, the others are not looked at. */
typedef struct plait_collider_desc {
    uint32_t struct_size;
    plait_collider_kind kind; /* default CAPSULE */
    plait_capsule capsule;    /* default: a sphere of 0.1 m about the origin */
    plait_plane plane;        /* default: through the origin, normal +y */
    plait_box box;            /* default: a cube of 0.2 m about the origin */
    float friction;  /* Coulomb coefficient, [0, 10], default 0.3, as of meshes and hulls */
    plait_pose pose; /* at creation */
    uint32_t inward; /* capsule, box: 1: hair stays inside of it, as in a hood or a sleeve; 0, the
                        default: outside. Wind, volume and shelter do not see one that is 1 */
    float scale;     /* factor of all lengths of its shape, [1e-3, 1e3]; 0, the default: as those of
                        the roots (plait_roots.scale), part of the character; 1: it keeps its size,
                        a floor or a wall. Its pose is in metres of the world, whatever this is */
} plait_collider_desc;
PLAIT_STRUCT(plait_collider_desc)
PLAIT_API plait_result plait_collider_create(plait_sim* sim, const plait_collider_desc* desc,
                                             plait_collider_id* out);

/* Where it will be at the end of the next plait_sim_step; interpolated from where it is. */
PLAIT_API plait_result plait_collider_set_pose(plait_sim* sim, plait_collider_id collider,
                                               const plait_pose* pose);
/* Puts it elsewhere at once, as if it had been there all the time, so that it sweeps no hair along;
 * positions that were set for a mesh of form NEAREST are where it is now, too. Hair inside is let out
 * (of a mesh of form NEAREST: up to 1 cm deep), and is on that side of a sheet where it is. Waits
 * only of a sheet of form NEAREST. */
PLAIT_API plait_result plait_collider_place(plait_sim* sim, plait_collider_id collider,
                                            const plait_pose* pose);
/* Shape and friction of `desc`, from the next fixed step on; hair that is inside then is pushed
 * out. desc->pose is checked and not used. @errors INVALID_STATE (it is a mesh or a hull) */
PLAIT_API plait_result plait_collider_set_shape(plait_sim* sim, plait_collider_id collider,
                                                const plait_collider_desc* desc);
/* As it was given: the shape of its kind (others are 0), friction, and the pose at the end of the next
 * plait_sim_step; of a hull the box around it along its own axes, with its margin as rounding. */
PLAIT_API plait_result plait_collider_describe(const plait_sim* sim, plait_collider_id collider,
                                               plait_collider_desc* out);
/* Those of a sim, restored ones too: a list. */
PLAIT_API plait_result plait_colliders_list(const plait_sim* sim, plait_collider_id* dst,
                                            size_t* count);
/* Its id is never used again. */
PLAIT_API plait_result plait_collider_destroy(plait_sim* sim, plait_collider_id collider);

/* ---- state ---------------------------------------------------------------------------------- */

/* V is the row length, nv the number of voxels along an edge of the grid. "With x" names the call
 * or the field of plait_sim_desc that turns it on. */
typedef enum plait_field {
    PLAIT_FIELD_POSITION = 0,     /* float[4] [strands][V]: x, y, z, inverse mass; for display */
    PLAIT_FIELD_TANGENT = 1,      /* float[4] [strands][V], unit, towards the tip */
    PLAIT_FIELD_VELOCITY = 2,     /* float[4] [guides][V], m/s; past a tip the tip's */
    PLAIT_FIELD_REST = 3,         /* float[4] [guides][V], at the groom's size */
    PLAIT_FIELD_VERTEX_COUNT = 4, /* uint32_t [strands] */
    /* float [nv^3], voxel y*nv^2 + z*nv + x; of hair at the groom's size, as GRID_VELOCITY */
    PLAIT_FIELD_GRID_DENSITY = 5,
    PLAIT_FIELD_GRID_VELOCITY = 6, /* float[4] [nv^3]: mean velocity, the grid's frame; rms speed */
    PLAIT_FIELD_POSITION_PREV = 7, /* float[4] [guides][V]: Verlet history */
    /* uint32_t [follows]: the guide that strand guides + i follows, with a follow_map the most */
    PLAIT_FIELD_FOLLOW_GUIDE = 8,
    /* float[4] [strands][V]: POSITION before the last plait_sim_step, for motion vectors; after
       creation, a teleport or a reset POSITION itself. With keep_last_frame */
    PLAIT_FIELD_POSITION_LAST_FRAME = 9,
    /* float[4] [2]: least and greatest x, y, z of POSITION, w 0; of what is finite, and if nothing
       is, FLT_MAX and -FLT_MAX. Computed on the device when it is read */
    PLAIT_FIELD_BOUNDS = 10,
    /* float[4] [guides][V], m/s^2, in the world, 0 at first: acceleration of a vertex beside
       gravity and air, in every model, until it is written again, by the caller or before each
       fixed step by the caller's kernel for the stage accelerate. A component that is not finite or
       beyond 1e4 is taken as 0. It acts as on hair of the groom's size, at any scale of the roots,
       as gravity does. Not part of a snapshot. With plait_sim_set_acceleration */
    PLAIT_FIELD_ACCELERATION = 11,
    /* float[4] [guides][V]: the target of a vertex that is pinned, m, and the stiffness of what
       holds it there, N/m: w > 0: in the world; w < 0: -w, and the target is a place in the groom
       that its strand's root carries along; 0, as at first: it is free. Filled by
       plait_sim_set_pins, or written by the caller as one array. Vertex 0 and rows past the tip are
       ignored. Model articulated */
    PLAIT_FIELD_PIN = 12,
    /* float [guides], [0, 1]: how wet a strand is, after the steps so far; 0, as at first: dry.
       Written, it acts from the next step on and dries with `drying_time`; below 1e-3 it is 0.
       A wet strand is heavier and softer, with volume it lies closer to others and holds to them,
       and its follows are drawn to it (docs/wetness.md). Material is scaled anew once wetness has
       moved by more than 0.02. Stays over reset and teleport; snapshots hold it. With
       plait_sim_set_wetness */
    PLAIT_FIELD_WETNESS = 13,
    PLAIT_FIELD_COUNT = 14,
    PLAIT_FIELD_FORCE_32 = 0x7fffffff
} plait_field;

/* Bytes. Waits. @errors INVALID_STATE (what would fill the field is off) */
PLAIT_API plait_result plait_sim_read(plait_sim* sim, plait_field field, void* dst, size_t* size);

/* Overwrites POSITION (guides only, [guides][V]; w is kept), POSITION_PREV, VELOCITY, ACCELERATION,
 * PIN or WETNESS. `size` must match. Values are within [-1e6, 1e6] m, [-1e4, 1e4] m/s, [-1e4, 1e4]
 * m/s^2, [-1e6, 1e6] N/m (0 at vertex 0) and [0, 1]. Waits.
 * @errors INVALID_STATE (its feature is off, or not one of the model's) */
PLAIT_API plait_result plait_sim_write(plait_sim* sim, plait_field field, const void* src,
                                       size_t size);

/* What only the device knows, now. */
typedef struct plait_sim_measures {
    uint32_t struct_size;
    float max_stretch; /* worst |l/l0 - 1| of any segment */
    float mean_stretch;
    float max_speed;       /* m/s */
    uint64_t nonfinite;    /* vertices; and those whose ACCELERATION is taken as 0 */
    uint64_t grid_outside; /* vertices outside the grid in the last fixed step */
    /* strand contact: segments with more than four others near; the four nearest count, likewise */
    uint64_t pairs_dropped;
} plait_sim_measures;
PLAIT_STRUCT(plait_sim_measures)

/* Waits. */
PLAIT_API plait_result plait_sim_measure(plait_sim* sim, plait_sim_measures* out);

/* The dynamic state (no parameters) as bytes that restore on any device, into a sim of the same
 * groom, model, step and substeps. A checksum, a fingerprint of the groom's strands as imported and
 * the ranges of all values are checked: what is restored is a state that the sim can continue from.
 * See docs/replay.md. Both wait.
 * @errors BAD_DATA (not a snapshot, damaged, cut, a value out of range), INVALID_ARGUMENT (of
 *         another groom, model or step), UNSUPPORTED (of another version) */
PLAIT_API plait_result plait_sim_save(plait_sim* sim, void* dst, size_t* size);
PLAIT_API plait_result plait_sim_restore(plait_sim* sim, const void* src, size_t size);

/* 64-bit hash of a snapshot: equal states, equal hashes. Waits. */
PLAIT_API plait_result plait_sim_hash(plait_sim* sim, uint64_t* out);

#ifdef __cplusplus
}
#endif

#include <plait/plait_features.h>
#include <plait/plait_mesh.h>

#endif
