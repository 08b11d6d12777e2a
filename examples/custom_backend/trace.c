/* A backend of one's own, as a shared module: `trace` wraps another backend and logs what every
 * dispatch does. Everything is passed on but enumerate, open and submit; buffers are those of the
 * wrapped backend.
 *
 * The wrapped backend is `reference`, or the one the environment variable PLAIT_TRACE names. */
#include <plait/plait_backend.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the core knows as a plait_device of this backend. */
typedef struct trace_device {
    const plait_device_api* api; /* of the wrapped backend */
    plait_device* device;
    plait_log_fn log;
    void* log_user;
} trace_device;

static trace_device* of(plait_device* device) {
    return (trace_device*)device;
}

static const plait_backend_api* wrapped(void) {
    const char* wanted = getenv("PLAIT_TRACE");
    for (size_t i = 0; i < plait_backend_count(); ++i)
        if (strcmp(plait_backend_get(i)->name, wanted ? wanted : "reference") == 0)
            return plait_backend_get(i);
    return NULL;
}

static plait_result trace_submit(plait_device* device, const plait_dispatch* list, size_t count) {
    const trace_device* self = of(device);
    for (size_t i = 0; self->log && i < count; ++i) {
        char line[96];
        snprintf(line, sizeof line, "trace: %s over %u items",
                 plait_stage_describe(list[i].stage)->name, (unsigned)list[i].item_count);
        self->log(PLAIT_LOG_LEVEL_INFO, line, self->log_user);
    }
    return self->api->submit(self->device, list, count);
}

static void trace_destroy(plait_device* device) {
    of(device)->api->destroy(of(device)->device);
    free(device);
}

static plait_result trace_describe(plait_device* device, plait_device_info* out) {
    const plait_result result = of(device)->api->describe(of(device)->device, out);
    snprintf(out->backend, sizeof out->backend, "trace");
    return result;
}

/* The rest is passed on as it is. */
#define SELF of(device)->api
#define INNER of(device)->device
static int trace_supports(plait_device* device, plait_stage stage) {
    return SELF->supports(INNER, stage);
}
static plait_result trace_buffer_create(plait_device* device, const plait_buffer_desc* desc,
                                        plait_buffer** out) {
    return SELF->buffer_create(INNER, desc, out);
}
static void trace_buffer_destroy(plait_device* device, plait_buffer* buffer) {
    SELF->buffer_destroy(INNER, buffer);
}
static plait_result trace_buffer_write(plait_device* device, plait_buffer* buffer, size_t first,
                                       size_t count, const void* src) {
    return SELF->buffer_write(INNER, buffer, first, count, src);
}
static plait_result trace_buffer_upload(plait_device* device, plait_buffer* buffer, size_t first,
                                        size_t count, const void* src) {
    return SELF->buffer_upload(INNER, buffer, first, count, src);
}
static plait_result trace_buffer_read(plait_device* device, plait_buffer* buffer, size_t first,
                                      size_t count, void* dst) {
    return SELF->buffer_read(INNER, buffer, first, count, dst);
}
static plait_result trace_prepare(plait_device* device, const plait_dispatch* list, size_t count) {
    return SELF->prepare(INNER, list, count);
}
static plait_result trace_wait(plait_device* device) {
    return SELF->wait(INNER);
}
static plait_result trace_stage_costs(plait_device* device, plait_stage_cost* dst, int reset) {
    return SELF->stage_costs(INNER, dst, reset);
}
static plait_result trace_take_launches(plait_device* device, plait_stage_launch* dst,
                                        size_t* count) {
    return SELF->take_launches(INNER, dst, count);
}
static const char* trace_last_error(plait_device* device) {
    return SELF->last_error(INNER);
}
static void* trace_native_buffer(plait_device* device, plait_buffer* buffer) {
    return SELF->native_buffer(INNER, buffer);
}
static void* trace_native_queue(plait_device* device) {
    return SELF->native_queue(INNER);
}
#undef SELF
#undef INNER

static const plait_device_api device_api = {
    sizeof(plait_device_api), trace_destroy,        trace_describe,     trace_supports,
    trace_buffer_create,      trace_buffer_destroy, trace_buffer_write, trace_buffer_upload,
    trace_buffer_read,        trace_submit,         trace_prepare,      trace_wait,
    trace_stage_costs,        trace_take_launches,  trace_last_error,   trace_native_buffer,
    trace_native_queue,
};

/* Never chosen by itself: whoever wants a trace asks for it by name. */
static int trace_score(void) {
    return -1;
}

static plait_result trace_enumerate(plait_device_info* dst, size_t* count) {
    const plait_backend_api* inner = wrapped();
    if (!inner)
        return PLAIT_NOT_FOUND;
    const plait_result result = inner->enumerate(dst, count);
    for (size_t i = 0; dst && result == PLAIT_OK && i < *count; ++i)
        snprintf(dst[i].backend, sizeof dst[i].backend, "trace");
    return result;
}

static plait_result trace_open(const plait_open_info* info, plait_device** out, char* error,
                               size_t error_size) {
    const plait_backend_api* inner = wrapped();
    trace_device* self = inner ? calloc(1, sizeof *self) : NULL;
    if (!self) {
        snprintf(error, error_size, inner ? "out of memory" : "there is no backend to trace");
        return inner ? PLAIT_OUT_OF_MEMORY : PLAIT_NOT_FOUND;
    }
    const plait_result result = inner->open(info, &self->device, error, error_size);
    if (result != PLAIT_OK) {
        free(self);
        return result;
    }
    self->api = inner->device;
    self->log = info->log;
    self->log_user = info->log_user;
    *out = (plait_device*)self;
    return PLAIT_OK;
}

static const plait_backend_api backend = {
    PLAIT_BACKEND_ABI, sizeof(plait_backend_api), "trace", trace_score, trace_enumerate, trace_open,
    &device_api,
};

/* The one name a module exports; the version is part of it. */
#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif
EXPORT const plait_backend_api* plait_backend_entry_v1(void);
const plait_backend_api* plait_backend_entry_v1(void) {
    return &backend;
}
