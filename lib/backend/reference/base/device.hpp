// The reference device: one thread, float64, every dispatch done when submit returns.
#pragma once

#include "backend/launches.hpp"
#include "backend/reference/base/buffer.hpp"
#include "base/memory.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <array>
#include <string>

namespace plait::reference {

plait_device_info device_info();

class Device {
  public:
    explicit Device(const plait_open_info& info)
        : memory_(info.allocator), profile_(info.profile != 0) {}

    Result<Buffer*> create(const plait_buffer_desc& desc);
    void destroy(Buffer* buffer);
    Status write(Buffer& buffer, size_t first, size_t count, const void* src);
    Status read(const Buffer& buffer, size_t first, size_t count, void* dst) const;
    Status submit(const plait_dispatch* list, size_t count);
    void costs(plait_stage_cost* dst, bool reset);
    void take_launches(plait_stage_launch* dst, size_t& count) { launches_.take(dst, count); }

    // Keeps the sentence of a failure for last_error and gives the code back.
    plait_result report(const Status& status);
    const char* last_error() const { return error_.c_str(); }

    // Devices live in the caller's memory too.
    static Device* make(const plait_open_info& info); // throws std::bad_alloc
    static void release(Device* device);

  private:
    void record(const plait_dispatch& dispatch, uint64_t begin, uint64_t end); // ns

    Memory memory_;
    bool profile_;
    std::array<plait_stage_cost, PLAIT_STAGE_COUNT> costs_{};
    Launches launches_;
    std::string error_;
};

} // namespace plait::reference
