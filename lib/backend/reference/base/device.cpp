#include "backend/reference/base/device.hpp"

#include "backend/reference/base/dispatch.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>

namespace plait::reference {
namespace {

uint64_t now_ns() {
    using namespace std::chrono;
    return static_cast<uint64_t>(
        duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count());
}

Status check_range(const char* verb, const Buffer& buffer, size_t first, size_t count) {
    if (count <= buffer.size() && first <= buffer.size() - count)
        return {};
    return Error{PLAIT_INVALID_ARGUMENT,
                 format("%s buffer '%s': elements %zu..%zu of %zu", verb, buffer.name(), first,
                        first + count, buffer.size())};
}

} // namespace

plait_device_info device_info() {
    plait_device_info info{};
    info.struct_size = sizeof info;
    std::snprintf(info.backend, sizeof info.backend, "reference");
    std::snprintf(info.platform, sizeof info.platform, "plait reference (float64)");
    std::snprintf(info.name, sizeof info.name, "one CPU thread");
    std::snprintf(info.vendor, sizeof info.vendor, "plait");
    std::snprintf(info.driver, sizeof info.driver, "%d.%d.%d", PLAIT_VERSION_MAJOR,
                  PLAIT_VERSION_MINOR, PLAIT_VERSION_PATCH);
    info.type = PLAIT_DEVICE_TYPE_CPU;
    info.compute_units = 1;
    info.float_width = 1;
    info.lanes = 1;
    info.tile = 1;
    info.max_group_size = PLAIT_MAX_VERTICES;
    return info;
}

Device* Device::make(const plait_open_info& info) {
    Memory memory(info.allocator);
    return new (memory.allocate(sizeof(Device), alignof(Device))) Device(info);
}

void Device::release(Device* device) {
    Memory memory = device->memory_;
    device->~Device();
    memory.deallocate(device, sizeof(Device), alignof(Device));
}

Result<Buffer*> Device::create(const plait_buffer_desc& desc) {
    const char* name = desc.name ? desc.name : "unnamed";
    if (desc.count == 0 || static_cast<uint32_t>(desc.element) > PLAIT_ELEMENT_UINT)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("buffer '%s': %zu elements of kind %d, at least 1 of kind 0..2", name,
                            desc.count, static_cast<int>(desc.element))};
    try {
        std::pmr::polymorphic_allocator<> allocator(&memory_);
        return allocator.new_object<Buffer>(desc, &memory_);
    } catch (const std::exception&) { // bad_alloc, or length_error beyond what a vector can hold
        return Error{PLAIT_OUT_OF_MEMORY,
                     format("buffer '%s': no memory for %zu elements", name, desc.count)};
    }
}

void Device::destroy(Buffer* buffer) {
    if (buffer)
        std::pmr::polymorphic_allocator<>(&memory_).delete_object(buffer);
}

Status Device::write(Buffer& buffer, size_t first, size_t count, const void* src) {
    PLAIT_TRY(check_range("writing", buffer, first, count));
    buffer.write(first, count, src);
    return {};
}

Status Device::read(const Buffer& buffer, size_t first, size_t count, void* dst) const {
    PLAIT_TRY(check_range("reading", buffer, first, count));
    buffer.read(first, count, dst);
    return {};
}

Status Device::submit(const plait_dispatch* list, size_t count) {
    for (const plait_dispatch* dispatch = list; dispatch != list + count; ++dispatch) {
        const uint64_t begin = profile_ ? now_ns() : 0;
        PLAIT_TRY(perform(*dispatch));
        ++costs_[dispatch->stage].calls;
        if (profile_)
            record(*dispatch, begin, now_ns());
    }
    return {};
}

void Device::record(const plait_dispatch& dispatch, uint64_t begin, uint64_t end) {
    costs_[dispatch.stage].seconds += static_cast<double>(end - begin) * 1e-9;
    if (dispatch.item_count > 0)
        launches_.add({dispatch.stage, dispatch.item_count, dispatch.bytes, begin, begin, end});
}

void Device::costs(plait_stage_cost* dst, bool reset) {
    std::copy(costs_.begin(), costs_.end(), dst);
    if (reset)
        costs_.fill({});
}

plait_result Device::report(const Status& status) {
    if (!status)
        error_ = status.error().message;
    return status.error().code;
}

} // namespace plait::reference
