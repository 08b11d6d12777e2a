// A backend's device and its buffers, owned: results become Status, handles are released.
#pragma once

#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <span>
#include <string>
#include <utility>

namespace plait {

// A device buffer, or none.
class Buffer {
  public:
    Buffer() = default;
    Buffer(const plait_device_api* api, plait_device* device, plait_buffer* handle,
           const plait_buffer_desc& desc)
        : api_(api), device_(device), handle_(handle), desc_(desc) {}
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept {
        Buffer(std::move(other)).swap(*this);
        return *this;
    }
    ~Buffer() {
        if (handle_)
            api_->buffer_destroy(device_, handle_);
    }

    void swap(Buffer& other) noexcept {
        std::swap(api_, other.api_);
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        std::swap(desc_, other.desc_);
    }

    explicit operator bool() const { return handle_ != nullptr; }
    plait_buffer* handle() const { return handle_; }
    const char* name() const { return desc_.name; }
    size_t count() const { return handle_ ? desc_.count : 0; }
    size_t element_size() const { return desc_.element == PLAIT_ELEMENT_FLOAT4 ? 16 : 4; }
    size_t bytes() const { return count() * element_size(); }

  private:
    const plait_device_api* api_ = nullptr;
    plait_device* device_ = nullptr;
    plait_buffer* handle_ = nullptr;
    plait_buffer_desc desc_{PLAIT_ELEMENT_FLOAT, 0, ""};
};

// An open device. Buffers must be gone before it is. Once it reports DEVICE_LOST it stays lost.
class Device {
  public:
    static Result<Device> open(const plait_backend_api& backend, const plait_open_info& info);

    Device(Device&& other) noexcept;
    Device& operator=(Device&&) = delete;
    ~Device();

    Result<plait_device_info> describe();
    bool supports(plait_stage stage) const { return api_->supports(handle_, stage) != 0; }

    // A buffer into `to`, which stays as it is on failure. `name` must outlive the buffer.
    Status create(Buffer& to, plait_element element, size_t count, const char* name);
    Status write(const Buffer& buffer, size_t first, size_t count, const void* src);
    Status write(const Buffer& buffer, const void* src) {
        return write(buffer, 0, buffer.count(), src);
    }
    // Copies `src` and does not wait for the device.
    Status upload(const Buffer& buffer, size_t first, size_t count, const void* src);
    Status upload(const Buffer& buffer, const void* src) {
        return upload(buffer, 0, buffer.count(), src);
    }
    Status read(const Buffer& buffer, size_t first, size_t count, void* dst);
    Status read(const Buffer& buffer, void* dst) { return read(buffer, 0, buffer.count(), dst); }

    // `dst` is filled once a fence made after it is reached.
    Status read_later(const Buffer& buffer, void* dst);
    Result<uint64_t> fence();
    // Whether it is; `wait`: until it is.
    Result<bool> fence_reached(uint64_t fence, bool wait);

    Status submit(std::span<const plait_dispatch> list);
    Status prepare(std::span<const plait_dispatch> list); // builds what the list needs
    Status wait();
    // Nothing where the backend has no such function: all is one sequence then.
    Status overlap(plait_overlap what);
    Status stage_costs(plait_stage_cost* dst, bool reset); // dst[PLAIT_STAGE_COUNT]
    Status take_launches(plait_stage_launch* dst, size_t& count);

    void* native_buffer(const Buffer& buffer) {
        return api_->native_buffer(handle_, buffer.handle());
    }
    void* native_queue() { return api_->native_queue(handle_); }

  private:
    Device(const plait_backend_api& backend, plait_device* handle)
        : backend_(backend.name), api_(backend.device), handle_(handle) {}
    template <typename Call> Status perform(const char* what, const Call& call);
    bool has_fences() const;

    const char* backend_;
    const plait_device_api* api_;
    plait_device* handle_;
    uint64_t last_fence_ = 0;
    std::string lost_; // the sentence of the loss; "" while the device is there
};

} // namespace plait
