// The C API of the backend: every function ends in a result code, none lets an exception through.
#include "backend/builtin.hpp"
#include "backend/opencl/device.hpp"

#include <algorithm>
#include <cstdio>
#include <new>

namespace plait::opencl {
namespace {

Device& unwrap(plait_device* device) {
    return *reinterpret_cast<Device*>(device);
}

Buffer& unwrap(plait_buffer* buffer) {
    return *reinterpret_cast<Buffer*>(buffer);
}

// Runs `call`; whatever it throws becomes an Error. The literals fit std::string without
// allocation.
template <typename Call> Status guard(const Call& call) noexcept {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        return Error{PLAIT_OUT_OF_MEMORY, "no host memory"};
    } catch (...) {
        return Error{PLAIT_INTERNAL, "an exception"};
    }
}

template <typename Call> plait_result perform(plait_device* handle, const Call& call) noexcept {
    Device& device = unwrap(handle);
    return device.report(guard([&]() -> Status {
        if (device.lost())
            return *device.lost();
        return call(device);
    }));
}

int score() {
    int value = -1;
    (void)guard([&]() -> Status {
        value = find_devices().usable.empty() ? -1 : 100;
        return {};
    });
    return value;
}

plait_result enumerate(plait_device_info* dst, size_t* count) {
    const Status status = guard([&]() -> Status {
        const Candidates found = find_devices();
        const size_t number = dst ? std::min(*count, found.usable.size()) : found.usable.size();
        for (size_t index = 0; dst && index < number; ++index)
            dst[index] = found.usable[index].info;
        *count = number;
        return {};
    });
    return status.error().code;
}

plait_result open(const plait_open_info* info, plait_device** out, char* error, size_t error_size) {
    const Status status = guard([&]() -> Status {
        auto device = Device::open(*info, Calls{});
        PLAIT_TRY(device);
        *out = reinterpret_cast<plait_device*>(device->release());
        return {};
    });
    if (!status.ok() && error && error_size > 0)
        std::snprintf(error, error_size, "%s", status.error().message.c_str());
    return status.error().code;
}

void destroy(plait_device* device) {
    delete &unwrap(device);
}

plait_result describe(plait_device* device, plait_device_info* out) {
    *out = unwrap(device).info();
    return PLAIT_OK;
}

int supports(plait_device* device, plait_stage stage) {
    return unwrap(device).supports(stage);
}

plait_result buffer_create(plait_device* device, const plait_buffer_desc* desc,
                           plait_buffer** out) {
    return perform(device, [&](Device& self) -> Status {
        auto buffer = self.create(*desc);
        PLAIT_TRY(buffer);
        *out = reinterpret_cast<plait_buffer*>(buffer->release());
        return {};
    });
}

void buffer_destroy(plait_device*, plait_buffer* buffer) {
    if (buffer)
        delete &unwrap(buffer);
}

plait_result buffer_write(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                          const void* src) {
    return perform(device,
                   [&](Device& self) { return self.write(unwrap(buffer), first, count, src); });
}

plait_result buffer_upload(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                           const void* src) {
    return perform(device,
                   [&](Device& self) { return self.upload(unwrap(buffer), first, count, src); });
}

plait_result buffer_read(plait_device* device, plait_buffer* buffer, size_t first, size_t count,
                         void* dst) {
    return perform(device,
                   [&](Device& self) { return self.read(unwrap(buffer), first, count, dst); });
}

plait_result buffer_read_later(plait_device* device, plait_buffer* buffer, size_t first,
                               size_t count, void* dst) {
    return perform(
        device, [&](Device& self) { return self.read_later(unwrap(buffer), first, count, dst); });
}

plait_result fence(plait_device* device, uint64_t* fence) {
    return perform(device, [&](Device& self) { return self.fence(*fence); });
}

plait_result fence_reached(plait_device* device, uint64_t fence, int wait, int* reached) {
    return perform(device, [&](Device& self) {
        bool is_reached = false;
        const Status status = self.fence_reached(fence, wait != 0, is_reached);
        *reached = is_reached ? 1 : 0;
        return status;
    });
}

plait_result submit(plait_device* device, const plait_dispatch* list, size_t count) {
    return perform(device, [&](Device& self) { return self.submit({list, count}); });
}

plait_result prepare(plait_device* device, const plait_dispatch* list, size_t count) {
    return perform(device, [&](Device& self) { return self.prepare({list, count}); });
}

plait_result wait(plait_device* device) {
    return perform(device, [](Device& self) { return self.wait(); });
}

plait_result stage_costs(plait_device* device, plait_stage_cost* dst, int reset) {
    return perform(device, [&](Device& self) { return self.costs(dst, reset != 0); });
}

plait_result take_launches(plait_device* device, plait_stage_launch* dst, size_t* count) {
    return perform(device, [&](Device& self) { return self.take_launches(dst, *count); });
}

const char* last_error(plait_device* device) {
    return unwrap(device).last_error().c_str();
}

void* native_buffer(plait_device*, plait_buffer* buffer) {
    return unwrap(buffer).memory.get();
}

void* native_queue(plait_device* device) {
    return unwrap(device).queue();
}

plait_result overlap(plait_device* device, plait_overlap what) {
    return perform(device, [&](Device& self) { return self.overlap(what); });
}

constexpr plait_device_api device_functions = {
    .struct_size = sizeof(plait_device_api),
    .destroy = destroy,
    .describe = describe,
    .supports = supports,
    .buffer_create = buffer_create,
    .buffer_destroy = buffer_destroy,
    .buffer_write = buffer_write,
    .buffer_upload = buffer_upload,
    .buffer_read = buffer_read,
    .submit = submit,
    .prepare = prepare,
    .wait = wait,
    .stage_costs = stage_costs,
    .take_launches = take_launches,
    .last_error = last_error,
    .native_buffer = native_buffer,
    .native_queue = native_queue,
    .overlap = overlap,
    .buffer_read_later = buffer_read_later,
    .fence = fence,
    .fence_reached = fence_reached,
};

constexpr plait_backend_api backend_functions = {
    .abi = PLAIT_BACKEND_ABI,
    .struct_size = sizeof(plait_backend_api),
    .name = "opencl",
    .score = score,
    .enumerate = enumerate,
    .open = open,
    .device = &device_functions,
};

} // namespace
} // namespace plait::opencl

const plait_backend_api* plait::opencl_backend() {
    return &opencl::backend_functions;
}
