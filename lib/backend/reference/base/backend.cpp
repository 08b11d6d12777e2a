// The C API of the reference backend: handles to objects, exceptions to result codes.
#include "backend/builtin.hpp"
#include "backend/reference/base/device.hpp"

#include <cstdio>
#include <new>

namespace plait {
namespace {

using reference::Buffer;
using reference::Device;

// The C types are each backend's own, so they are only ever names for ours.
Device& device_of(plait_device* handle) {
    return *reinterpret_cast<Device*>(handle);
}
Buffer& buffer_of(plait_buffer* handle) {
    return *reinterpret_cast<Buffer*>(handle);
}

// No exception leaves the backend; the only one left by now is a sentence that found no memory.
template <typename Call> plait_result guarded(Call&& call) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return PLAIT_OUT_OF_MEMORY;
    } catch (...) {
        return PLAIT_INTERNAL;
    }
}

int score() {
    return 0;
} // any device that is made for the work is better

plait_result enumerate(plait_device_info* dst, size_t* count) {
    if (dst && *count > 0)
        *dst = reference::device_info();
    if (!dst || *count > 1)
        *count = 1;
    return PLAIT_OK;
}

plait_result open(const plait_open_info* info, plait_device** out, char* error, size_t size) {
    if (info->device_index != 0) {
        std::snprintf(error, size, "reference: device %u does not exist, there is one",
                      info->device_index);
        return PLAIT_NOT_FOUND;
    }
    if (info->stage_source_count != 0) {
        std::snprintf(error, size, "reference: stage sources need an OpenCL device");
        return PLAIT_UNSUPPORTED;
    }
    const plait_result result = guarded([&] {
        *out = reinterpret_cast<plait_device*>(Device::make(*info));
        return PLAIT_OK;
    });
    if (result != PLAIT_OK)
        std::snprintf(error, size, "reference: no memory for a device");
    return result;
}

void destroy(plait_device* device) {
    if (device)
        Device::release(&device_of(device));
}

plait_result describe(plait_device*, plait_device_info* out) {
    *out = reference::device_info();
    return PLAIT_OK;
}

int supports(plait_device*, plait_stage stage) {
    return static_cast<uint32_t>(stage) < PLAIT_STAGE_COUNT;
}

plait_result buffer_create(plait_device* device, const plait_buffer_desc* desc,
                           plait_buffer** out) {
    return guarded([&] {
        const auto buffer = device_of(device).create(*desc);
        if (!buffer)
            return device_of(device).report(buffer.error());
        *out = reinterpret_cast<plait_buffer*>(*buffer);
        return PLAIT_OK;
    });
}

void buffer_destroy(plait_device* device, plait_buffer* buffer) {
    device_of(device).destroy(reinterpret_cast<Buffer*>(buffer));
}

plait_result buffer_write(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                          const void* src) {
    return guarded([&] {
        return device_of(device).report(
            device_of(device).write(buffer_of(buffer), first, count, src));
    });
}

plait_result buffer_read(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                         void* dst) {
    return guarded([&] {
        return device_of(device).report(
            device_of(device).read(buffer_of(buffer), first, count, dst));
    });
}

plait_result submit(plait_device* device, const plait_dispatch* list, size_t count) {
    return guarded([&] { return device_of(device).report(device_of(device).submit(list, count)); });
}

plait_result prepare(plait_device*, const plait_dispatch*, size_t) {
    return PLAIT_OK;
} // nothing is built

plait_result wait(plait_device*) {
    return PLAIT_OK;
} // submit has done it all

plait_result stage_costs(plait_device* device, plait_stage_cost* dst, int reset) {
    device_of(device).costs(dst, reset != 0);
    return PLAIT_OK;
}

plait_result take_launches(plait_device* device, plait_stage_launch* dst, size_t* count) {
    device_of(device).take_launches(dst, *count);
    return PLAIT_OK;
}

const char* last_error(plait_device* device) {
    return device_of(device).last_error();
}
void* native_buffer(plait_device*, plait_buffer*) {
    return nullptr;
}
void* native_queue(plait_device*) {
    return nullptr;
}

constexpr plait_device_api device_api = {
    sizeof(plait_device_api),
    destroy,
    describe,
    supports,
    buffer_create,
    buffer_destroy,
    buffer_write,
    buffer_write, // upload: there is nothing to wait for
    buffer_read,
    submit,
    prepare,
    wait,
    stage_costs,
    take_launches,
    last_error,
    native_buffer,
    native_queue,
    // overlap, buffer_read_later, fence, fence_reached: it runs each list while it is submitted
    nullptr,
    nullptr,
    nullptr,
    nullptr,
};

constexpr plait_backend_api backend_api = {
    PLAIT_BACKEND_ABI, sizeof(plait_backend_api), "reference", score, enumerate, open, &device_api,
};

} // namespace

const plait_backend_api* reference_backend() {
    return &backend_api;
}

} // namespace plait
