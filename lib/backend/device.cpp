#include "backend/device.hpp"

#include "base/format.hpp"

#include <cinttypes>
#include <cstddef>

namespace plait {

Result<Device> Device::open(const plait_backend_api& backend, const plait_open_info& info) {
    char text[16384] = "";
    plait_device* handle = nullptr;
    const plait_result result = backend.open(&info, &handle, text, sizeof text);
    if (result != PLAIT_OK)
        return Error{result, format("backend %s: %s", backend.name,
                                    *text ? text : plait_result_string(result))};
    if (!handle)
        return Error{PLAIT_BACKEND, format("backend %s: open gave no device", backend.name)};
    return Device(backend, handle);
}

Device::Device(Device&& other) noexcept
    : backend_(other.backend_), api_(other.api_), handle_(std::exchange(other.handle_, nullptr)),
      lost_(std::move(other.lost_)) {}

Device::~Device() {
    if (handle_)
        api_->destroy(handle_);
}

template <typename Call> Status Device::perform(const char* what, const Call& call) {
    if (!lost_.empty())
        return Error{PLAIT_DEVICE_LOST, lost_};
    const plait_result result = call();
    if (result == PLAIT_OK)
        return {};
    const char* text = api_->last_error(handle_);
    Error error{result, format("backend %s: %s: %s", backend_, what,
                               text && *text ? text : plait_result_string(result))};
    if (result == PLAIT_DEVICE_LOST)
        lost_ = error.message;
    return error;
}

Result<plait_device_info> Device::describe() {
    plait_device_info info{};
    info.struct_size = sizeof info;
    PLAIT_TRY(perform("describe", [&] { return api_->describe(handle_, &info); }));
    return info;
}

Status Device::create(Buffer& to, plait_element element, size_t count, const char* name) {
    const plait_buffer_desc desc{element, count, name};
    plait_buffer* handle = nullptr;
    PLAIT_TRY(perform(name, [&] { return api_->buffer_create(handle_, &desc, &handle); }));
    to = Buffer(api_, handle_, handle, desc);
    return {};
}

Status Device::write(const Buffer& buffer, size_t first, size_t count, const void* src) {
    return perform(buffer.name(),
                   [&] { return api_->buffer_write(handle_, buffer.handle(), first, count, src); });
}

Status Device::upload(const Buffer& buffer, size_t first, size_t count, const void* src) {
    return perform(buffer.name(), [&] {
        return api_->buffer_upload(handle_, buffer.handle(), first, count, src);
    });
}

Status Device::read(const Buffer& buffer, size_t first, size_t count, void* dst) {
    return perform(buffer.name(),
                   [&] { return api_->buffer_read(handle_, buffer.handle(), first, count, dst); });
}

bool Device::has_fences() const {
    const size_t end = offsetof(plait_device_api, fence_reached) + sizeof api_->fence_reached;
    return api_->struct_size >= end && api_->buffer_read_later && api_->fence &&
           api_->fence_reached;
}

Status Device::read_later(const Buffer& buffer, void* dst) {
    if (!has_fences())
        return read(buffer, dst);
    return perform(buffer.name(), [&] {
        return api_->buffer_read_later(handle_, buffer.handle(), 0, buffer.count(), dst);
    });
}

Result<uint64_t> Device::fence() {
    uint64_t next = last_fence_ + 1;
    if (has_fences())
        PLAIT_TRY(perform("fence", [&] { return api_->fence(handle_, &next); }));
    else
        PLAIT_TRY(wait());
    return last_fence_ = next;
}

Result<bool> Device::fence_reached(uint64_t fence, bool wait) {
    if (fence < 1 || fence > last_fence_)
        return Error{PLAIT_INVALID_ARGUMENT,
                     last_fence_ == 0 ? "there is no fence yet"
                                      : format("fence is %" PRIu64 ", range is [1, %" PRIu64
                                               "], the fences that were made",
                                               fence, last_fence_)};
    int reached = 1;
    if (has_fences())
        PLAIT_TRY(perform(
            "fence", [&] { return api_->fence_reached(handle_, fence, wait ? 1 : 0, &reached); }));
    return reached != 0;
}

Status Device::submit(std::span<const plait_dispatch> list) {
    return perform("submit", [&] { return api_->submit(handle_, list.data(), list.size()); });
}

Status Device::prepare(std::span<const plait_dispatch> list) {
    return perform("prepare", [&] { return api_->prepare(handle_, list.data(), list.size()); });
}

Status Device::wait() {
    return perform("wait", [&] { return api_->wait(handle_); });
}

Status Device::overlap(plait_overlap what) {
    const size_t end = offsetof(plait_device_api, overlap) + sizeof api_->overlap;
    if (api_->struct_size < end || !api_->overlap)
        return {};
    return perform("overlap", [&] { return api_->overlap(handle_, what); });
}

Status Device::stage_costs(plait_stage_cost* dst, bool reset) {
    return perform("stage times", [&] { return api_->stage_costs(handle_, dst, reset); });
}

Status Device::take_launches(plait_stage_launch* dst, size_t& count) {
    return perform("launches", [&] { return api_->take_launches(handle_, dst, &count); });
}

} // namespace plait
