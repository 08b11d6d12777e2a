/* The interface a kernel backend implements, and the table of stages it performs.
 *
 * The core decides which stage runs over what and in which order; a backend owns memory and runs
 * lists of stages. Nothing here knows about hair beyond the stage table. C99.
 * In-tree: `opencl` and `reference` (float64). A backend registers at run time with
 * plait_backend_register, or as a shared module loaded by plait_backend_load.
 */
#ifndef PLAIT_BACKEND_H
#define PLAIT_BACKEND_H

#include <plait/params.h>
#include <plait/plait.h>
#include <plait/plait_profile.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when the meaning of anything in this file or in stages.def changes. */
#define PLAIT_BACKEND_ABI 1

/* ---- stages --------------------------------------------------------------------------------- */

typedef enum plait_stage {
#define PLAIT_STAGE(name, space, params, summary) PLAIT_STAGE_##name,
#include <plait/stages.def>
    PLAIT_STAGE_COUNT,
    PLAIT_STAGE_FORCE_32 = 0x7fffffff
} plait_stage;

typedef enum plait_space {
    PLAIT_SPACE_VERTEX = 0,
    PLAIT_SPACE_STRAND = 1,
    PLAIT_SPACE_VOXEL = 2,
    PLAIT_SPACE_WORD = 3,
    PLAIT_SPACE_STRAND_GROUP = 4, /* item_width work-items of one work-group per strand */
    PLAIT_SPACE_VOXEL_GROUP = 5,  /* item_width work-items of one work-group per voxel */
    PLAIT_SPACE_LANES = 6, /* strands, `lanes` of them per work-item; the kernel is specialised */
    PLAIT_SPACE_FORCE_32 = 0x7fffffff
} plait_space;

typedef enum plait_element {
    PLAIT_ELEMENT_FLOAT = 0,
    PLAIT_ELEMENT_FLOAT4 = 1,
    PLAIT_ELEMENT_UINT = 2,
    PLAIT_ELEMENT_REAL = 3, /* floats in the lane layout, [tile][V][components][tile strands] */
    PLAIT_ELEMENT_FORCE_32 = 0x7fffffff
} plait_element;

typedef enum plait_access {
    PLAIT_ACCESS_READ = 0,
    PLAIT_ACCESS_WRITE = 1,
    PLAIT_ACCESS_READWRITE = 2,
    PLAIT_ACCESS_LOCAL = 3, /* work-group memory, one element per work-item; no buffer */
    PLAIT_ACCESS_FORCE_32 = 0x7fffffff
} plait_access;

typedef struct plait_stage_arg {
    const char* name;
    plait_element element;
    plait_access access;
} plait_stage_arg;

typedef struct plait_stage_info {
    plait_stage stage;
    const char* name;        /* "tressfx_wind" */
    const char* kernel;      /* "plait_tressfx_wind" */
    const char* params_type; /* "plait_tressfx_wind_params" */
    const char* summary;
    plait_space space;
    uint32_t params_size;
    uint32_t arg_count;    /* LOCAL arguments included */
    uint32_t buffer_count; /* LOCAL arguments excluded */
    const plait_stage_arg* args;
} plait_stage_info;

/* NULL if `stage` is out of range. Static storage. */
PLAIT_API const plait_stage_info* plait_stage_describe(plait_stage stage);

/* Bytes that a stage over item_count items has to move through memory at least, as OpenCL keeps
 * them: of each buffer what the items touch, once for reading and once for writing. `elements` of
 * its buffers, in the order of its non-LOCAL arguments, 0: none is passed; strands have
 * `vertices_per_strand`. 0 if `stage` is out of range. */
PLAIT_API uint64_t plait_stage_traffic(plait_stage stage, uint32_t item_count,
                                       uint32_t vertices_per_strand, const size_t* elements);

/* ---- memory and work ------------------------------------------------------------------------ */

typedef struct plait_device plait_device; /* the backend's own */
typedef struct plait_buffer plait_buffer; /* the backend's own */

typedef struct plait_buffer_desc {
    plait_element element;
    size_t count;     /* elements, > 0 */
    const char* name; /* for messages */
} plait_buffer_desc;

/* One stage over item_count items. `buffers` follow the stage's non-LOCAL arguments; an entry may
 * be NULL where stages.def says so. */
typedef struct plait_dispatch {
    plait_stage stage;
    uint32_t item_count;
    uint32_t item_width; /* work-items per item in the _GROUP spaces (V, or slots read in parallel);
                            vertices per strand in LANES; else 1 */
    const void* params;
    uint32_t params_size;
    uint32_t buffer_count;
    plait_buffer* const* buffers;
    uint64_t bytes; /* plait_stage_traffic; handed on with the launch, 0: not computed */
} plait_dispatch;

typedef struct plait_stage_cost {
    uint64_t calls;
    double seconds;
} plait_stage_cost;

/* A dispatch that has ended, as in plait_launch. */
typedef struct plait_stage_launch {
    plait_stage stage;
    uint32_t item_count;
    uint64_t bytes;
    uint64_t queued_ns, begin_ns, end_ns; /* all 0: unknown */
} plait_stage_launch;

typedef enum plait_overlap {
    PLAIT_OVERLAP_BEGIN = 0, /* sequences follow, each behind all that was submitted before */
    PLAIT_OVERLAP_NEXT = 1,  /* the next sequence: it and those before touch no common buffer */
    PLAIT_OVERLAP_END = 2,   /* what follows is behind all of them */
    PLAIT_OVERLAP_FORCE_32 = 0x7fffffff
} plait_overlap;

typedef struct plait_device_api {
    uint32_t struct_size; /* sizeof, or less by optional functions, which are then absent */
    void (*destroy)(plait_device*);
    plait_result (*describe)(plait_device*, plait_device_info*);
    int (*supports)(plait_device*, plait_stage);
    /* Contents are undefined until written. */
    plait_result (*buffer_create)(plait_device*, const plait_buffer_desc*, plait_buffer**);
    /* Work submitted before may still use the buffer: its memory goes when that is done. */
    void (*buffer_destroy)(plait_device*, plait_buffer*);
    /* Elements cross as float32/uint32 whatever the backend keeps inside. Write and read wait. */
    plait_result (*buffer_write)(plait_device*, plait_buffer*, size_t first, size_t count,
                                 const void* src);
    /* The same without waiting: takes a copy of `src`, and writes it when what was submitted before
     * is done. What fails later is reported by a later call. */
    plait_result (*buffer_upload)(plait_device*, plait_buffer*, size_t first, size_t count,
                                  const void* src);
    plait_result (*buffer_read)(plait_device*, plait_buffer*, size_t first, size_t count,
                                void* dst);
    /* In order, as if each waited for the one before. Copies params before it returns. */
    plait_result (*submit)(plait_device*, const plait_dispatch* list, size_t count);
    /* Makes ready what submitting the list would first take time for. Of each entry `stage`,
     * `item_width` and, about, item_count matter (0: unknown); params may be NULL, buffers are not
     * looked at. No buffer changes and no cost is counted. @errors COMPILE */
    plait_result (*prepare)(plait_device*, const plait_dispatch* list, size_t count);
    plait_result (*wait)(plait_device*);
    /* dst[PLAIT_STAGE_COUNT]; reset != 0 starts over. Seconds are 0 without profiling. */
    plait_result (*stage_costs)(plait_device*, plait_stage_cost* dst, int reset);
    /* With profiling every dispatch of at least one item since the last call, in order, of more
     * than PLAIT_LAUNCHES_KEPT the newest; without none. dst == NULL: waits and writes their
     * number; else writes at most *count, the oldest first, and forgets these. */
    plait_result (*take_launches)(plait_device*, plait_stage_launch* dst, size_t* count);
    /* The sentence behind the last failure; "" if none. */
    const char* (*last_error)(plait_device*);
    /* cl_mem for opencl; NULL where there is nothing to share. */
    void* (*native_buffer)(plait_device*, plait_buffer*);
    /* cl_command_queue for opencl; NULL elsewhere. */
    void* (*native_queue)(plait_device*);

    /* ---- optional: NULL, or beyond struct_size ---- */

    /* Between BEGIN and END come submit, buffer_upload and NEXT alone. Each sequence is in order;
     * different ones may run at once, and need not begin before END. Where BEGIN fails there is
     * nothing to end. Without it all is one sequence. */
    plait_result (*overlap)(plait_device*, plait_overlap what);
    /* buffer_read without waiting: dst is filled once a fence made after it is reached. All three or
     * none; without them reads wait, and fences are reached. */
    plait_result (*buffer_read_later)(plait_device*, plait_buffer*, size_t first, size_t count,
                                      void* dst);
    /* A number behind all work so far, larger than those before. */
    plait_result (*fence)(plait_device*, uint64_t* fence);
    /* *reached: whether the work before a fence that was made is done; wait != 0: waits until it is.
     * Fails as `wait` does where work before it failed. */
    plait_result (*fence_reached)(plait_device*, uint64_t fence, int wait, int* reached);
} plait_device_api;

typedef struct plait_open_info {
    uint32_t struct_size;
    uint32_t device_index; /* of the backend's own enumeration */
    uint32_t profile;
    plait_log_fn log; /* may be NULL */
    void* log_user;
    plait_allocator allocator; /* functions may be NULL */
    const plait_stage_source* stage_sources;
    size_t stage_source_count;
    uint32_t lanes;             /* as in plait_context_desc */
    const char* program_folder; /* as in plait_context_desc; may be NULL, and may be ignored */
    const void* native; /* backend-specific handles to adopt; NULL: the backend makes its own */
} plait_open_info;

typedef struct plait_backend_api {
    uint32_t abi;         /* PLAIT_BACKEND_ABI */
    uint32_t struct_size; /* sizeof(plait_backend_api) */
    const char* name;
    /* Preference among backends; the highest is the default; negative: never chosen by itself. */
    int (*score)(void);
    /* dst == NULL: needed count. Devices best first. */
    plait_result (*enumerate)(plait_device_info* dst, size_t* count);
    /* On failure writes a sentence to error[error_size]. */
    plait_result (*open)(const plait_open_info*, plait_device** out, char* error,
                         size_t error_size);
    const plait_device_api* device;
} plait_backend_api;

/* ---- registry ------------------------------------------------------------------------------- */

/* Adds a backend for the rest of the process; `api` must live as long. Threads: any.
 * @errors INVALID_ARGUMENT (ABI or size mismatch, missing function, name taken: it says which) */
PLAIT_API plait_result plait_backend_register(const plait_backend_api* api);

/* Loads a shared module that exports
 *     const plait_backend_api* plait_backend_entry_v1(void);
 * and registers what it returns. Never unloaded. @errors NOT_FOUND, UNSUPPORTED (no such symbol) */
PLAIT_API plait_result plait_backend_load(const char* path);

/* The built-in ones first. Threads: any. */
PLAIT_API size_t plait_backend_count(void);
PLAIT_API const plait_backend_api* plait_backend_get(size_t index); /* NULL: out of range */

#ifdef __cplusplus
}
#endif

#endif
