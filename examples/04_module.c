/* A backend of your own as a shared module: `trace` is another backend that says what it runs.
 *
 * A backend is two tables of functions (plait/plait_backend.h). One that wraps another starts from
 * that one's tables and changes what it wants to: here the name, and `submit`. It hands out the
 * other's devices and buffers, so everything else is the other's. One that computes by itself fills
 * every entry.
 *
 * What is wrapped is `reference`, or what the environment variable PLAIT_TRACE names. */
#include <plait/plait_backend.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const plait_backend_api* wrapped;
static plait_backend_api backend; /* plait keeps the addresses: they live as long as the process */
static plait_device_api device_api;

/* Buffers, parameters and items of each dispatch are the core's; `params` may be gone when this
 * returns. A backend runs the list in order and need not wait for its end. */
static plait_result trace_submit(plait_device* device, const plait_dispatch* list, size_t count) {
    for (size_t i = 0; i < count; ++i)
        printf("trace: %s over %u items\n", plait_stage_describe(list[i].stage)->name,
               (unsigned)list[i].item_count);
    return wrapped->device->submit(device, list, count);
}

static plait_result trace_describe(plait_device* device, plait_device_info* out) {
    const plait_result result = wrapped->device->describe(device, out);
    snprintf(out->backend, sizeof out->backend, "trace");
    return result;
}

/* dst NULL asks for the count alone. */
static plait_result trace_enumerate(plait_device_info* dst, size_t* count) {
    const plait_result result = wrapped->enumerate(dst, count);
    for (size_t i = 0; dst && result == PLAIT_OK && i < *count; ++i)
        snprintf(dst[i].backend, sizeof dst[i].backend, "trace");
    return result;
}

/* Negative: never chosen by itself. Whoever wants a trace asks for it by name. */
static int trace_score(void) {
    return -1;
}

/* The one name a module exports; the version of the interface is part of it. NULL: there is nothing
 * to register, and plait_backend_load says so. */
#ifdef _WIN32
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif
EXPORT const plait_backend_api* plait_backend_entry_v1(void);
const plait_backend_api* plait_backend_entry_v1(void) {
    const char* wanted = getenv("PLAIT_TRACE");
    for (size_t i = 0; i < plait_backend_count() && !wrapped; ++i)
        if (strcmp(plait_backend_get(i)->name, wanted ? wanted : "reference") == 0)
            wrapped = plait_backend_get(i);
    if (!wrapped)
        return NULL;
    device_api = *wrapped->device;
    device_api.submit = trace_submit;
    device_api.describe = trace_describe;
    backend = *wrapped; /* its ABI and sizes, and how it opens a device */
    backend.name = "trace";
    backend.score = trace_score;
    backend.enumerate = trace_enumerate;
    backend.device = &device_api;
    return &backend;
}
