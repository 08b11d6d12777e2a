/* plait: real-time hair simulation on any OpenCL device. C99.
 *
 * A `plait_context` is a device; a `plait_groom` is immutable hair at rest; a `plait_sim` is one
 * groom moving on one context. SI units, right-handed axes, quaternions stored (x, y, z, w). A pose
 * maps a rest-space point p to q*p + t in the world. docs/concepts.md shows the calls of a frame.
 *
 * Headers:   this one has what a simulation needs; plait_offline.h has tools that need no context,
 *            plait_recorder.h and plait_formats.h are for files, plait_profile.h measures,
 *            plait_opencl.h shares buffers, plait_backend.h is for backends.
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
#define PLAIT_VERSION_MINOR 1
#define PLAIT_VERSION_PATCH 0
/* Of this header; plait_version() is that of the library that is linked. */
#define PLAIT_VERSION_NUMBER                                                                       \
    (PLAIT_VERSION_MAJOR * 10000 + PLAIT_VERSION_MINOR * 100 + PLAIT_VERSION_PATCH)

/* Bytes, of any struct in any version: a struct_size beyond is one that was not initialised. */
#define PLAIT_STRUCT_SIZE_MAX 4096

/* Defines `plait_x_defaults()`, which returns the struct by value; for the headers of plait. */
#define PLAIT_DEFAULTS(type)                                                                       \
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
    X(CANCELLED, 12, "the caller's progress function ended it")

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
PLAIT_API void plait_device_info_init(plait_device_info* info, size_t size);

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
PLAIT_API void plait_context_desc_init(plait_context_desc* desc, size_t size);

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
PLAIT_API void plait_import_options_init(plait_import_options* options, size_t size);

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
PLAIT_API void plait_groom_desc_init(plait_groom_desc* desc, size_t size);

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
    uint64_t roots_contradicted; /* strands likely stored from tip to root: only the tip lies among
                                    the other roots */
    uint64_t thickness_unlikely; /* strands whose diameter is no hair's, 10 um to 1 mm */
    char warning[512];           /* what of this is likely wrong, in sentences; "": nothing */
} plait_groom_info;
PLAIT_API void plait_groom_info_init(plait_groom_info* info, size_t size);
PLAIT_API plait_result plait_groom_describe(const plait_groom* groom, plait_groom_info* out);

typedef enum plait_groom_field {
    PLAIT_GROOM_FIELD_POSITIONS = 0,     /* float[3] [vertices] */
    PLAIT_GROOM_FIELD_VERTEX_COUNTS = 1, /* uint32_t [strands] */
    PLAIT_GROOM_FIELD_STRAND_UV = 2,     /* float[2] [strands] */
    PLAIT_GROOM_FIELD_THICKNESS = 3,     /* float [strands] */
    PLAIT_GROOM_FIELD_BONE_INDICES = 4,  /* uint32_t[4] [strands] */
    PLAIT_GROOM_FIELD_BONE_WEIGHTS = 5,  /* float[4] [strands] */
    PLAIT_GROOM_FIELD_FORCE_32 = 0x7fffffff
} plait_groom_field;

/* After repairs: bytes. */
PLAIT_API plait_result plait_groom_read(const plait_groom* groom, plait_groom_field field,
                                        void* dst, size_t* size);

/* ---- meshes --------------------------------------------------------------------------------- */

/* Repairs of a mesh; by the plait_repair_policy, as of grooms. */
typedef enum plait_mesh_repair {
    /* within 1e-6 of the mesh's size of one before that the same bones move: a seam */
    PLAIT_MESH_REPAIR_WELDED_VERTEX = 0,
    PLAIT_MESH_REPAIR_DEGENERATE_TRIANGLE = 1, /* without area: dropped */
    PLAIT_MESH_REPAIR_DUPLICATE_TRIANGLE = 2,  /* the corners of one before: dropped */
    PLAIT_MESH_REPAIR_FLIPPED_TRIANGLE = 3,    /* faces another way than its surface: turned */
    /* of files: of more than four bones the heaviest four, scaled to sum 1; of none the first */
    PLAIT_MESH_REPAIR_REDUCED_SKIN = 4,
    PLAIT_MESH_REPAIR_COUNT = 5,
    PLAIT_MESH_REPAIR_FORCE_32 = 0x7fffffff
} plait_mesh_repair;

/* Triangles that hair may collide with: a head, a body, a collar. See docs/meshes.md. */
typedef struct plait_mesh_desc {
    uint32_t struct_size;
    plait_view positions; /* float[3], m, each [-1e6, 1e6] [vertices]; of no triangle: not read */
    plait_view triangles; /* uint32_t[3], each below positions.count, counter-clockwise from outside
                             [triangles] */
    plait_view bone_indices; /* uint32_t[4], each below 65536 [vertices]; or empty */
    plait_view bone_weights; /* float[4], each [0, 1], sum 1 within 1e-3 [vertices]; or empty */
} plait_mesh_desc;
PLAIT_API void plait_mesh_desc_init(plait_mesh_desc* desc, size_t size);

/* `options` NULL: defaults; of them policy, scale, axes, pose and allocator are read.
 * @errors BAD_DATA (triangle or vertex, value and range; nothing left; policy REFUSE) */
PLAIT_API plait_result plait_mesh_create(const plait_mesh_desc* desc,
                                         const plait_import_options* options, plait_mesh** out);

/* By extension: .obj, .gltf (with the .bin it names), .glb: all faces of all objects, where their
 * nodes put them, polygons as triangles, of glTF with the skin; .tfxmesh (TressFX 4.1), with it,
 * too.
 * @errors NOT_FOUND, IO, BAD_DATA (file, triangle or line, value, range), UNSUPPORTED (unknown
 *         extension, or built without assimp) */
PLAIT_API plait_result plait_mesh_load(const char* path, const plait_import_options* options,
                                       plait_mesh** out);
PLAIT_API void plait_mesh_destroy(plait_mesh* mesh);

typedef struct plait_mesh_info {
    uint32_t struct_size;
    uint64_t vertices;
    uint64_t triangles;
    uint64_t open_edges;    /* of one triangle; 0: closed, if unsided_edges is 0, too */
    uint64_t unsided_edges; /* of three or more, or where no turning makes neighbours agree */
    uint32_t components;    /* that hang together by edges */
    float bounds_min[3];    /* m */
    float bounds_max[3];
    double volume;                             /* m^3, of the closed components */
    double area;                               /* m^2 */
    uint64_t repairs[PLAIT_MESH_REPAIR_COUNT]; /* vertices or triangles, by kind */
    uint64_t repairs_total;
    char first_repair[192]; /* "triangle 17: has no area, dropped" or "" */
    uint32_t bones;         /* of its skin; 0: none */
} plait_mesh_info;
PLAIT_API void plait_mesh_info_init(plait_mesh_info* info, size_t size);
PLAIT_API plait_result plait_mesh_describe(const plait_mesh* mesh, plait_mesh_info* out);

typedef enum plait_mesh_field {
    PLAIT_MESH_FIELD_POSITIONS = 0, /* float[3] [vertices] */
    PLAIT_MESH_FIELD_TRIANGLES = 1, /* uint32_t[3] [triangles] */
    /* uint32_t [vertices]: the number each had when it came in, of welded ones the first, so that
       positions[i] = came[sources[i]] also when the mesh that came in moves */
    PLAIT_MESH_FIELD_SOURCES = 2,
    PLAIT_MESH_FIELD_BONE_INDICES = 3, /* uint32_t[4] [vertices] */
    PLAIT_MESH_FIELD_BONE_WEIGHTS = 4, /* float[4] [vertices], sum 1 */
    PLAIT_MESH_FIELD_FORCE_32 = 0x7fffffff
} plait_mesh_field;

/* After repairs: bytes. */
PLAIT_API plait_result plait_mesh_read(const plait_mesh* mesh, plait_mesh_field field, void* dst,
                                       size_t* size);

/* A bone as the mesh's file has it. Its skinning matrix is its present pose in the space of the
 * mesh, 3x4, times inverse_bind. */
typedef struct plait_mesh_bone_info {
    uint32_t struct_size;
    char name[64];          /* UTF-8, cut if longer; of meshes from arrays "" */
    float inverse_bind[12]; /* 3x4 row-major, m: from the mesh at rest to the bone. The identity
                               where the mesh is from arrays or .tfxmesh, which have none */
} plait_mesh_bone_info;
PLAIT_API void plait_mesh_bone_info_init(plait_mesh_bone_info* info, size_t size);

/* @errors NOT_FOUND (`index` is not below plait_mesh_info.bones) */
PLAIT_API plait_result plait_mesh_read_bone(const plait_mesh* mesh, uint32_t index,
                                            plait_mesh_bone_info* out);

/* Where bones put the vertices, for plait_collider_set_positions: a linear blend on the host, on
 * any thread. `bones`: float[12], 3x4 row-major skinning matrices as in plait_roots.bones, at least
 * as many as the mesh has, each finite and neither singular nor reflecting. `positions`: float[3],
 * m [vertices]; identities give PLAIT_MESH_FIELD_POSITIONS. @errors INVALID_STATE (no skin) */
PLAIT_API plait_result plait_mesh_pose(const plait_mesh* mesh, const plait_view* bones,
                                       float* positions);

/* ---- parameters ----------------------------------------------------------------------------- */

typedef enum plait_model {
    PLAIT_MODEL_TRESSFX = 0, /* parity with TressFX and the thesis; see docs/models/tressfx.md */
    PLAIT_MODEL_ARTICULATED = 1, /* inextensible rod; see docs/models/articulated.md */
    PLAIT_MODEL_FORCE_32 = 0x7fffffff
} plait_model;

/* Forms of a formula: PUBLISHED and THRESHOLD as in TressFX 4, THESIS as in Ugurca 2015; the others
 * are our corrections. What each corrects: docs/models/tressfx.md. */
typedef enum plait_wind_form {
    PLAIT_WIND_FORM_PUBLISHED = 0,
    PLAIT_WIND_FORM_DRAG = 1,
    PLAIT_WIND_FORM_FORCE_32 = 0x7fffffff
} plait_wind_form;
typedef enum plait_follow_form {
    PLAIT_FOLLOW_FORM_PUBLISHED = 0,
    PLAIT_FOLLOW_FORM_ROTATING = 1,
    PLAIT_FOLLOW_FORM_FORCE_32 = 0x7fffffff
} plait_follow_form;
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
typedef enum plait_interhair {
    PLAIT_INTERHAIR_OFF = 0,
    PLAIT_INTERHAIR_SLOTS = 1,
    PLAIT_INTERHAIR_EXACT = 2,
    PLAIT_INTERHAIR_FORCE_32 = 0x7fffffff
} plait_interhair;
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

typedef enum plait_volume_form {
    PLAIT_VOLUME_OFF = 0,
    PLAIT_VOLUME_PRESSURE = 1,
    PLAIT_VOLUME_FORCE_32 = 0x7fffffff
} plait_volume_form;
typedef enum plait_strand_contact_form {
    PLAIT_STRAND_CONTACT_OFF = 0,
    PLAIT_STRAND_CONTACT_ON = 1,
    PLAIT_STRAND_CONTACT_FORCE_32 = 0x7fffffff
} plait_strand_contact_form;

/* A value of bdf2: 1 unless strand_contact is on. */
#define PLAIT_BDF2_OF_MODEL 0xffffffffu

/* What may change between steps. Values outside the ranges in brackets are refused. */
typedef struct plait_sim_params {
    uint32_t struct_size;
    float gravity[3]; /* m/s^2, default (0, -9.81, 0), each [-1e4, 1e4] */

    /* model tressfx */
    float damping;                 /* [0, 100], default 0.08 */
    float local_stiffness;         /* [0, 1], default 0.9 */
    uint32_t local_iterations;     /* [0, 64], default 2 */
    float global_stiffness;        /* [0, 1], default 0 */
    float global_range;            /* [0, 1], default 0 */
    uint32_t length_iterations;    /* [0, 256], default 2 */
    float vsp_coeff;               /* [0, 1], default 0.8 */
    float vsp_accel_threshold;     /* m, [0, 1e6], default 1.4 */
    float max_displacement;        /* clamp per substep, m, (0, 1e6], default 1e6: off */
    float attachment;              /* largest distance from the root over arc length, [0, 100],
                                      default 0: off; 1: the strand as a whole does not stretch */
    float tip_separation;          /* of follows_per_guide, [0, 100], default 0 */
    plait_wind_form wind_form;     /* default DRAG */
    plait_follow_form follow_form; /* of follows_per_guide, default ROTATING */
    plait_shock_form shock_form;   /* default THRESHOLD */
    plait_stage_order order;       /* default PUBLISHED */

    /* model articulated: SI material of a strand */
    uint32_t iterations;     /* Newton steps, [0, 64], default 1 */
    uint32_t bdf2;           /* 0: backward Euler; 1: BDF2; or PLAIT_BDF2_OF_MODEL (default) */
    float line_density;      /* rho A, kg/m, [1e-9, 1e3], default 5e-6 */
    float bend_stiffness;    /* EI, N m^2, [0, 1e3], default 4.7e-9 (a hair of 70 um at 4 GPa) */
    float stretch_stiffness; /* EA, N, [0, 1e9], default 0: of 1 % stretch under its weight at 10 g.
                                Only kernels of the caller's for the stage articulated read it */
    float twist_stiffness;   /* GJ, N m^2, [0, 1e3], default 0: as bend_stiffness */
    float section_ratio;     /* EI2/EI of an ellipse, [1e-3, 1e3], default 1: round. A strand
                                curls about the axis of bend_stiffness */
    float tip_stiffness; /* of bend and twist, tip over root, linear between, [0, 100], default 1 */
    float tip_density;   /* of line_density, likewise, [1e-3, 1e3], default 1 */
    float drag;          /* 1/s, against the wind, [0, 1e4], default 2: swings halve in 0.7 s */

    float groom; /* [0, 1], default 0: the share of a level strand's droop under its weight that is
                    taken away; 1: hair stays as groomed. docs/groom.md */

    /* wind; docs/wind.md */
    float wind[3];       /* m/s, each [-1e3, 1e3], default 0; with no drag: no wind stage */
    float air_with_head; /* [0, 1], share of the head's velocity that the air has, at the middle of
                            the groom; 1: under a hat; default 0. Model articulated */
    float air_drag;      /* rho_air C_d d / (2 rho A), 1/m, [0, 1e6], default 0 */
    float wind_cone;     /* published form: its half angle, rad, [0, pi/2], default 0.7 */

    /* inter-hair step, once per fixed step; docs/grid.md */
    plait_interhair interhair;       /* default OFF */
    uint32_t grid_edge_count;        /* [1, 64], default 8 */
    uint32_t slot_capacity;          /* [1, 65536], default 1024 */
    plait_slot_hash_rule slot_hash;  /* default PCG */
    plait_tent_form tent;            /* default VOXEL (slots is always VOXEL) */
    plait_diffuse_rule diffuse_rule; /* default FLOORED */
    float diffuse_ratio;             /* [0, 1e6], default 2 */
    float diffuse_factor;            /* [0, 1], default 0.9 */
    float diffuse_floor;             /* [0, 1], default 0.5 */
    uint32_t grid_in_world;          /* 0: moves and turns with the head; 1: fixed in the world */
    float grid_origin[3]; /* corner, m, each [-1e6, 1e6], where grid_edge > 0; of world or head */
    float grid_edge;      /* whole edge, m, [0, 1e6]; 0: a cube around the groom's bounds x 1.5 */

    /* volume: hair keeps the room it has in the groom. Model articulated, with interhair EXACT,
       whose braking it replaces; docs/volume.md */
    plait_volume_form volume; /* default OFF */
    float volume_share;       /* density to keep, over that at rest, [0, 4], default 1 */
    uint32_t volume_sweeps;   /* of the pressure's solve, per fixed step, [1, 64], default 10 */
    float volume_rate;        /* 1/s: hair that is too dense parts no faster, [0, 1e3], default 5 */
    float volume_viscosity;   /* 1/s: hair takes on the velocity around it, [0, 1e3], default 5 */
    float cohesion; /* m^2/s^2: tension that hair bears, over its density, [0, 1e4], default 0 */

    /* wetness, where PLAIT_FIELD_WETNESS was written. Model articulated; docs/wetness.md */
    float drying_time;  /* tau, s: it falls with e^(-t/tau), [0, 1e9], default 0: it stays */
    float wet_cohesion; /* m^2/s^2, with volume: cohesion of wetness 1, [0, 1e4], default 0.03 */

    /* guide strands meet each other. Model articulated; docs/strand_contact.md */
    plait_strand_contact_form strand_contact; /* default OFF */
    float strand_radius;   /* m, (0, 0.1], default 0.002: half the distance of guides */
    float strand_friction; /* Coulomb coefficient, [0, 10], default 0.3 */

    uint32_t follow_contact; /* 1 (default): strands that follow by a map are turned out of
                                colliders, except of meshes that are two_sided; 0: they are not */

    float accelerate_values[16]; /* each [-1e6, 1e6], default 0: passed to the caller's kernel for
                                    accelerate, which defines them; a warning if none runs */
} plait_sim_params;
PLAIT_API void plait_sim_params_init(plait_sim_params* params, size_t size);

/* What some strands of a sim are made of, in place of the params' fields of the same names (and of
 * tip_stiffness and tip_density, which the ramps replace). Ramps have knots at the root, a third,
 * two thirds of the arc length and the tip, linear between. Model articulated; docs/concepts.md. */
typedef struct plait_material {
    uint32_t struct_size;
    float line_density;      /* kg/m, [1e-9, 1e3], default 5e-6 */
    float bend_stiffness;    /* N m^2, [0, 1e3], default 4.7e-9 */
    float stretch_stiffness; /* N, [0, 1e9], default 0: as in the params */
    float twist_stiffness;   /* N m^2, [0, 1e3], default 0: as bend_stiffness */
    float section_ratio;     /* [1e-3, 1e3], default 1 */
    float curl;              /* scale of the turn at rest of every joint but the clamp, [0, 4],
                                default 1: as groomed; 0: straight */
    float clamp_stiffness;   /* scale of what holds the first segment in its direction, [0, 100],
                                default 1; 0: a hinge */
    float stiffness_ramp[4]; /* scale of bend and twist stiffness, each [0, 100], default 1 */
    float density_ramp[4];   /* scale of line_density, each [1e-3, 1e3], default 1 */
    float drag_scale;        /* scale of the params' `drag` and of a wind's, [0, 100], default 1 */
    float friction_scale;    /* scale of friction with colliders and strands, [0, 100], default 1;
                                of two strands each feels its own */
    float groom_stiffness;   /* N/m^2, [0, 1e6], default 0: a spring of groom_stiffness x l draws
                                hair of length l to its place in the groom. Adds to that of the
                                params' `groom` */
    float groom_ramp[4];     /* scale of both, each [0, 100], default 1 */
} plait_material;
PLAIT_API void plait_material_init(plait_material* material, size_t size);

/* As a strand's material: none of the list, but what the params say. */
#define PLAIT_MATERIAL_OF_PARAMS 0xffffffffu

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
    uint32_t keep_last_frame; /* 1: POSITION_LAST_FRAME exists; default 0 */
    uint32_t accelerations;   /* 1: ACCELERATION exists and acts; default 0 */
    uint32_t pins; /* 1: vertices may be pinned, PIN exists; tressfx refuses it; default 0 */
    uint32_t follows_per_guide;         /* copies beside each guide, [0, 64], default 0 */
    float follow_radius;                /* m, [0, 1], default 0.003 */
    uint64_t seed;                      /* follow offsets and slot hash */
    const plait_follow_map* follow_map; /* or NULL; with it follows_per_guide is 0 */
    plait_view strand_stiffness;        /* float [guides] or empty: factor of bend and twist
                                           stiffness, [0, 1e6] */
    const plait_material* materials;    /* [material_count] or NULL */
    size_t material_count;
    plait_view strand_material; /* uint32_t [guides], into `materials`; or empty */
    plait_sag_free sag_free;    /* tressfx refuses it. Default OFF */
    plait_sim_params params;
} plait_sim_desc;
PLAIT_API void plait_sim_desc_init(plait_sim_desc* desc, size_t size);

/* `desc` NULL: all defaults. Strands are stored [strands][V], V the longest of the groom and its
 * follow map; shorter strands are padded with copies of their tip. Guides, the groom's strands,
 * come first, then follows, guide by guide or as in the map. The head starts at the identity.
 * Waits: the hair is on the device then, at rest. Logs the warnings of plait_groom_info and
 * plait_sim_info and, as plait_sim_set_params does, parameters away from their defaults that the
 * model does not read; the next step logs those whose feature is off.
 * @errors UNSUPPORTED (also tressfx with V beyond the device's work-group) */
PLAIT_API plait_result plait_sim_create(plait_context* context, const plait_groom* groom,
                                        const plait_sim_desc* desc, plait_sim** out);
PLAIT_API void plait_sim_destroy(plait_sim* sim);

/* Sets every vertex to its rest position at the present roots, at rest relative to the head, whose
 * motion it takes on in the next step; clock and accumulator to 0. */
PLAIT_API plait_result plait_sim_reset(plait_sim* sim);

/* What a sim is, what it has done, and the result of its sag-free start. */
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
PLAIT_API void plait_sim_info_init(plait_sim_info* info, size_t size);

/* From the host; leaves the device alone. */
PLAIT_API plait_result plait_sim_describe(const plait_sim* sim, plait_sim_info* out);

/* From the next step on. Waits where material, sag or BDF2 change. */
PLAIT_API plait_result plait_sim_set_params(plait_sim* sim, const plait_sim_params* params);
PLAIT_API plait_result plait_sim_get_params(const plait_sim* sim, plait_sim_params* params);

/* One field of them by its name, for sliders, consoles and bindings. `values` has each of its
 * components (plait_param_info.count of plait_offline.h): a FLOAT is rounded to float32, a UINT and a CHOICE are whole
 * numbers. For the rest as plait_sim_set_params with this field changed. `dst` is a list.
 * @errors NOT_FOUND (no field has this name), and those of plait_sim_set_params. */
PLAIT_API plait_result plait_sim_set_param(plait_sim* sim, const char* name, const double* values,
                                           size_t count);
PLAIT_API plait_result plait_sim_get_param(const plait_sim* sim, const char* name, double* dst,
                                           size_t* count);

/* What guide strands are made of, from the next step on. `strand_material`, uint32_t [guides], says
 * of each which of `materials` it is, or PLAIT_MATERIAL_OF_PARAMS; empty with one material: all are
 * of it; `count` 0: all are of the params again. strand_stiffness scales these, too. Hair moves on
 * from where it is. The shape at rest stays the groom's, but for `curl`; a sag-free start is found
 * anew, and then curls. Waits.
 * @errors INVALID_STATE (model tressfx) */
PLAIT_API plait_result plait_sim_set_materials(plait_sim* sim, const plait_material* materials,
                                               size_t count, plait_view strand_material);

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
PLAIT_API void plait_strand_settings_init(plait_strand_settings* settings, size_t size);

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

/* ---- roots and frames ----------------------------------------------------------------------- */

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
PLAIT_API void plait_roots_init(plait_roots* roots, size_t size);

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

/* Where on a mesh a root is bound. */
typedef struct plait_root_place {
    uint32_t triangle; /* of PLAIT_MESH_FIELD_TRIANGLES */
    float weights[3];  /* of its corners, where it is nearest to the root; their sum is 1 */
    float height;      /* m, of the root above the triangle's plane */
    float distance;    /* m, from the root to that place */
} plait_root_place;

/* Binds the root of every guide to the triangle of `mesh` that is nearest to it, the groom and the
 * mesh lying as they were made, in one frame; NULL: roots are free again. From the next
 * plait_sim_set_roots on, with plait_roots.mesh_positions, a root keeps its place over the triangle
 * and its height above it, and turns as the triangle does (the closest rotation). The log warns of
 * roots that are farther than 1 cm from the mesh. `dst`: NULL, or `count` places, one per guide,
 * which a call that fails may write. Waits. Not part of a snapshot. See docs/meshes.md. */
PLAIT_API plait_result plait_sim_bind_roots(plait_sim* sim, const plait_mesh* mesh,
                                            plait_root_place* dst, size_t count);

/* Carries the hair rigidly to new roots, and to their scale, at once, without dynamics. Hair keeps
 * its motion relative to the head. It feels nothing if the head moves on as before, turned by the
 * teleport; if the head's velocity in the next step differs by 0.9 m/s or more, hair takes on the
 * new one. Colliders are at once where their poses were last set: set those that go along first.
 * `roots` are those of plait_sim_set_roots. */
PLAIT_API plait_result plait_sim_teleport(plait_sim* sim, const plait_roots* roots);

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
PLAIT_API void plait_frame_desc_init(plait_frame_desc* desc, size_t size);

/* Where the frame will be, once per frame, beside plait_sim_set_roots; on the way it interpolates.
 * The first call, the first after NULL, a teleport and a step of 0 s put it there at once; NULL: no
 * frame. Roots, colliders, pins and winds stay places in the world, whether they go along or not,
 * and gravity keeps its direction. With shares of 1 and air UNFELT steps give the bits of no frame;
 * with shares of 0 hair moves as if the frame stood still. Snapshots hold it. */
PLAIT_API plait_result plait_sim_set_frame(plait_sim* sim, const plait_frame_desc* desc);

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

/* What hair stays out of. A kind reads the fields that name it, and friction, pose and scale; the
 * others are kept and not looked at. Lengths are in metres, in the collider's own frame. */
typedef struct plait_collider_desc {
    uint32_t struct_size;
    float a[3];      /* one end of a capsule, a point of a plane, the centre of a box; +-1e6 */
    float b[3];      /* capsule: the other end; a == b: a sphere */
    float radius_a;  /* capsule: at a, (0, 1e3] */
    float radius_b;  /* capsule: at b, the same */
    float friction;  /* Coulomb coefficient, [0, 10] */
    plait_pose pose; /* at creation */

    plait_collider_kind kind;
    float normal[3]; /* plane: outward, where hair may be; each +-1e6, of length [1e-6, 2e6] */
    float half_extents[3]; /* box: half its edges before it is rounded, [0, 1e3]; 0 in all three: a
                              sphere, in two: a capsule */
    float rounding;        /* box: all within this of it belongs to it, [0, 1e3] */
    float orientation[4];  /* box: a unit quaternion, x y z w, from its edges to the own frame */
    uint32_t inward; /* capsule, box: 1: hair stays inside of it, as in a hood or a sleeve; 0, the
                        default: outside. Wind, volume and shelter do not see one that is 1 */
    float scale;     /* factor of all lengths of its shape, [1e-3, 1e3]; 0, the default: as those of
                        the roots (plait_roots.scale), part of the character; 1: it keeps its size,
                        a floor or a wall. Its pose is in metres of the world, whatever this is */
} plait_collider_desc;
PLAIT_API void plait_collider_desc_init(plait_collider_desc* desc, size_t size);
PLAIT_API plait_result plait_collider_create(plait_sim* sim, const plait_collider_desc* desc,
                                             plait_collider_id* out);

/* How hair finds a mesh. */
typedef enum plait_mesh_form {
    /* rigid, by distances on a grid, made once: loses what is thinner than two cells, or sharper */
    PLAIT_MESH_FORM_FIELD = 0,
    /* by its nearest triangle: exact, for meshes that bend, are thin or open; dearer where hair is
       near */
    PLAIT_MESH_FORM_NEAREST = 1,
    PLAIT_MESH_FORM_FORCE_32 = 0x7fffffff
} plait_mesh_form;

typedef struct plait_collider_mesh_desc {
    uint32_t struct_size;
    uint32_t cells; /* of FIELD, along the grid's longest side, [8, 256], default 48 */
    float margin;   /* m, hair stays so far outside, less within twice of it from its root, [0,
                       0.05], default 5e-4 */
    float friction; /* Coulomb coefficient, [0, 10], default 0.3 */
    /* 1, the default: no vertex is pushed farther out than it is where the groom has it, the roots
       and the mesh being where they are now; 0: all are */
    uint32_t clearance;
    /* 0: the mesh is closed, and hair stays outside. 1: it is a sheet, closed or not: hair stays,
       by FIELD a cell's edge, by NEAREST the margin from it on the side where it is. By NEAREST a
       vertex belongs to the side where it was first, until it goes round a rim */
    uint32_t two_sided;
    plait_pose pose; /* at creation */

    plait_mesh_form form; /* default FIELD */
} plait_collider_mesh_desc;
PLAIT_API void plait_collider_mesh_desc_init(plait_collider_mesh_desc* desc, size_t size);

/* As large as the roots' scale makes it. Model articulated; a vertex meets one mesh in a substep,
 * the deepest, beside all other colliders. Waits.
 * @errors INVALID_STATE (model tressfx), INVALID_ARGUMENT (also open edges, and others that leave
 *         it without sides, where two_sided is 0) */
PLAIT_API plait_result plait_collider_create_mesh(plait_sim* sim, const plait_mesh* mesh,
                                                  const plait_collider_mesh_desc* desc,
                                                  plait_collider_id* out);

/* Faces of a hull, at most. */
#define PLAIT_HULL_FACES_MAX 256

/* A convex body with flat faces, where box and capsule are too plain. Rigid, for both models, at
 * the cost of a box and a dot product per face. See docs/meshes.md. */
typedef struct plait_collider_hull_desc {
    uint32_t struct_size;
    float margin;    /* m: every face lies so far outside, [0, 1e3], default 0; edges stay sharp */
    float friction;  /* Coulomb coefficient, [0, 10], default 0.3 */
    float tolerance; /* of the mesh's size: how far it may be from convex, and triangles of one face
                        from its plane, [1e-6, 0.1], default 1e-4. The hull holds all of it */
    plait_pose pose; /* at creation */
    uint32_t inward; /* as plait_collider_desc.inward; the margin is then on the inside */
    float scale;     /* as plait_collider_desc.scale, of its faces and its margin */
} plait_collider_hull_desc;
PLAIT_API void plait_collider_hull_desc_init(plait_collider_hull_desc* desc, size_t size);

/* Of a closed convex mesh: its faces are the planes of its triangles, those that lie in one plane
 * together.
 * @errors INVALID_ARGUMENT (also open edges, and others that leave it without an inside; flat; not
 *         convex, with the edge and by how much; more than PLAIT_HULL_FACES_MAX faces) */
PLAIT_API plait_result plait_collider_create_hull(plait_sim* sim, const plait_mesh* mesh,
                                                  const plait_collider_hull_desc* desc,
                                                  plait_collider_id* out);

/* Where it will be at the end of the next plait_sim_step; interpolated from where it is. */
PLAIT_API plait_result plait_collider_set_pose(plait_sim* sim, plait_collider_id collider,
                                               const plait_pose* pose);
/* Puts it elsewhere at once, as if it had been there all the time, so that it sweeps no hair along;
 * positions that were set for a mesh of form NEAREST are where it is now, too. Hair that is inside
 * then is let out, and hair is on that side of a sheet where it is. Waits only of a sheet of form
 * NEAREST. */
PLAIT_API plait_result plait_collider_place(plait_sim* sim, plait_collider_id collider,
                                            const plait_pose* pose);
/* Where the vertices of a mesh of form NEAREST, PLAIT_MESH_FIELD_POSITIONS, will be at the end of
 * the next plait_sim_step, in the collider's own frame: float[3], m, each [-1e6, 1e6], as many as
 * there are; interpolated from where they are. They have the roots' scale in them, that of the next
 * step's end, stay until the next call, and are meanwhile as large as roots are. Hair on it goes
 * along with what moves and stretches under it.
 * @errors INVALID_STATE (no mesh, or of form FIELD) */
PLAIT_API plait_result plait_collider_set_positions(plait_sim* sim, plait_collider_id collider,
                                                    const plait_view* positions);
/* Shape and friction of `desc`, from the next fixed step on; hair that is inside then is pushed
 * out. desc->pose is checked and not used. @errors INVALID_STATE (it is a mesh or a hull) */
PLAIT_API plait_result plait_collider_set_shape(plait_sim* sim, plait_collider_id collider,
                                                const plait_collider_desc* desc);
/* As it was given: shape, friction, and the pose at the end of the next plait_sim_step; of a mesh
 * kind, friction and pose, the rest is 0; of a hull the box around it along its own axes, too: a,
 * half_extents, and as rounding its margin. */
PLAIT_API plait_result plait_collider_describe(const plait_sim* sim, plait_collider_id collider,
                                               plait_collider_desc* out);
/* Those of a sim, restored ones too: a list. */
PLAIT_API plait_result plait_colliders_list(const plait_sim* sim, plait_collider_id* dst,
                                            size_t* count);
/* Its id is never used again. */
PLAIT_API plait_result plait_collider_destroy(plait_sim* sim, plait_collider_id collider);

/* ---- pins ----------------------------------------------------------------------------------- */

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
 * @errors INVALID_STATE (plait_sim_desc.pins is 0) */
PLAIT_API plait_result plait_sim_set_pins(plait_sim* sim, const plait_pin* pins, size_t count);

/* ---- wind ----------------------------------------------------------------------------------- */

/* Air that moves past strands and drags them, each vertex as a slender cylinder with the drag of
 * its Reynolds number: mean velocity, gusts of all of it, and eddies that it carries along. Adds to
 * `wind` and `air_with_head` of the params, to which their linear `drag` stays relative. Formulae:
 * docs/wind.md. */
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
PLAIT_API void plait_wind_desc_init(plait_wind_desc* desc, size_t size);

/* From the next step on; NULL: none, as at first. Its time and its eddies go on when it is changed,
 * and start anew with plait_sim_reset, or after NULL; snapshots hold them, and a sim without wind
 * leaves them there.
 * @errors INVALID_STATE (model tressfx, whose wind is that of its params) */
PLAIT_API plait_result plait_sim_set_wind(plait_sim* sim, const plait_wind_desc* desc);

/* ---- detail of follows ---------------------------------------------------------------------- */

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
PLAIT_API void plait_detail_desc_init(plait_detail_desc* desc, size_t size);

/* From the next step or reset on, which shows positions; NULL: none, as at first. In every model;
 * not part of a snapshot. Waits.
 * @errors INVALID_STATE (no follows) */
PLAIT_API plait_result plait_sim_set_detail(plait_sim* sim, const plait_detail_desc* desc);

/* ---- state ---------------------------------------------------------------------------------- */

/* V is the row length, nv the number of voxels along an edge of the grid. "With x" names the field
 * of plait_sim_desc that turns it on. */
typedef enum plait_field {
    PLAIT_FIELD_POSITION = 0,     /* float[4] [strands][V]: x, y, z, inverse mass; for display */
    PLAIT_FIELD_TANGENT = 1,      /* float[4] [strands][V], unit, towards the tip */
    PLAIT_FIELD_VELOCITY = 2,     /* float[4] [guides][V], m/s */
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
       as gravity does. Not part of a snapshot. With accelerations */
    PLAIT_FIELD_ACCELERATION = 11,
    /* float[4] [guides][V]: the target of a vertex that is pinned, m, and the stiffness of what
       holds it there, N/m: w > 0: in the world; w < 0: -w, and the target is a place in the groom
       that its strand's root carries along; 0, as at first: it is free. Filled by
       plait_sim_set_pins, or written by the caller as one array. Vertex 0 and rows past the tip are
       ignored. With pins */
    PLAIT_FIELD_PIN = 12,
    /* float [guides], [0, 1]: how wet a strand is, after the steps so far; 0, as at first: dry.
       Once written it acts from the next step on and dries with `drying_time`; below 1e-3 it is 0.
       A wet strand is heavier and softer, with volume it lies closer to others and holds to them,
       and its follows are drawn to it (docs/wetness.md). Material is scaled anew once wetness has
       moved by more than 0.02. Stays over reset and teleport; snapshots hold it. Model
       articulated */
    PLAIT_FIELD_WETNESS = 13,
    PLAIT_FIELD_COUNT = 14,
    PLAIT_FIELD_FORCE_32 = 0x7fffffff
} plait_field;

/* Bytes. Waits. @errors INVALID_STATE (what would fill the field is off) */
PLAIT_API plait_result plait_sim_read(plait_sim* sim, plait_field field, void* dst, size_t* size);

/* Overwrites POSITION (guides only, [guides][V]; w is kept), POSITION_PREV, VELOCITY, ACCELERATION,
 * PIN or WETNESS. `size` must match. Values are within [-1e6, 1e6] m, [-1e4, 1e4] m/s, [-1e4, 1e4]
 * m/s^2, [-1e6, 1e6] N/m (0 at vertex 0) and [0, 1]. Waits.
 * @errors INVALID_STATE (accelerations or pins is off; WETNESS in model tressfx) */
PLAIT_API plait_result plait_sim_write(plait_sim* sim, plait_field field, const void* src,
                                       size_t size);

typedef struct plait_sim_stats {
    uint32_t struct_size;
    uint64_t guides;
    uint64_t strands;             /* guides and follows */
    uint32_t vertices_per_strand; /* V, the row length */
    uint64_t steps;               /* fixed steps done */
    uint64_t steps_dropped;       /* beyond max_steps_per_call */
    double time;                  /* s simulated */
    float max_stretch;            /* worst |l/l0 - 1| of any segment, now */
    float mean_stretch;
    uint64_t nonfinite;    /* vertices, now; and those whose ACCELERATION is taken as 0 */
    float max_speed;       /* m/s, now */
    uint64_t grid_outside; /* vertices outside the grid in the last inter-hair step */
    uint64_t device_bytes; /* buffers of this sim */

    /* with sag_free, as in plait_sim_info */
    float sag_residual;
    float worst_stiffening;
    uint64_t joints_stiffened;
    uint64_t sag_unstable;

    /* with strand_contact: pairs beyond the four nearest of each segment, in the last fixed step */
    uint64_t pairs_dropped;
} plait_sim_stats;
PLAIT_API void plait_sim_stats_init(plait_sim_stats* stats, size_t size);

/* Measures on the device. Waits. */
PLAIT_API plait_result plait_sim_get_stats(plait_sim* sim, plait_sim_stats* out);

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
    PLAIT_FEATURE_PINS = 64,           /* plait_sim_desc.pins */
    PLAIT_FEATURE_GROOM = 128,         /* plait_sim_params.groom, plait_material.groom_stiffness */
    PLAIT_FEATURE_ACCELERATIONS = 256, /* plait_sim_desc.accelerations */
    PLAIT_FEATURE_WIND = 512,          /* plait_sim_set_wind; of tressfx, that of the params */
    PLAIT_FEATURE_INTERHAIR = 1024,    /* plait_sim_params.interhair EXACT */
    PLAIT_FEATURE_SLOTS = 2048,        /* the same, SLOTS */
    PLAIT_FEATURE_VOLUME = 4096,       /* plait_sim_params.volume */
    PLAIT_FEATURE_STRAND_CONTACT = 8192, /* plait_sim_params.strand_contact */
    PLAIT_FEATURE_FOLLOWS = 16384,       /* plait_sim_desc.follow_map, follows_per_guide */
    PLAIT_FEATURE_DETAIL = 32768,        /* plait_sim_set_detail */
    PLAIT_FEATURE_WETNESS = 65536,       /* PLAIT_FIELD_WETNESS */
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
PLAIT_API void plait_prepare_desc_init(plait_prepare_desc* desc, size_t size);

/* Builds now what sims will take, for a loading screen, which takes seconds where nothing is
 * cached: whatever they do then that `desc` names, in grids of up to 32 voxels each way, compiles
 * nothing. `desc` NULL: all defaults. Calls for several grooms add up. Meanwhile other threads may
 * use everything but this context and its sims. What was built stays when it ends early; called
 * again it goes on. Waits.
 * @errors CANCELLED (by `progress`) */
PLAIT_API plait_result plait_context_prepare(plait_context* context,
                                             const plait_prepare_desc* desc);

/* ---- defaults, by value --------------------------------------------------------------------- */

PLAIT_DEFAULTS(plait_device_info)
PLAIT_DEFAULTS(plait_context_desc)
PLAIT_DEFAULTS(plait_import_options)
PLAIT_DEFAULTS(plait_groom_desc)
PLAIT_DEFAULTS(plait_groom_info)
PLAIT_DEFAULTS(plait_mesh_desc)
PLAIT_DEFAULTS(plait_mesh_info)
PLAIT_DEFAULTS(plait_mesh_bone_info)
PLAIT_DEFAULTS(plait_sim_params)
PLAIT_DEFAULTS(plait_material)
PLAIT_DEFAULTS(plait_sim_desc)
PLAIT_DEFAULTS(plait_sim_info)
PLAIT_DEFAULTS(plait_strand_settings)
PLAIT_DEFAULTS(plait_roots)
PLAIT_DEFAULTS(plait_frame_desc)
PLAIT_DEFAULTS(plait_collider_desc)
PLAIT_DEFAULTS(plait_collider_mesh_desc)
PLAIT_DEFAULTS(plait_collider_hull_desc)
PLAIT_DEFAULTS(plait_wind_desc)
PLAIT_DEFAULTS(plait_detail_desc)
PLAIT_DEFAULTS(plait_sim_stats)
PLAIT_DEFAULTS(plait_prepare_desc)

#ifdef __cplusplus
}
#endif

#endif
