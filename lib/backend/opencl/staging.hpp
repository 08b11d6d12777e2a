// Host memory that uploads are copied to, so that the caller's array is free at once and nobody
// waits for the device.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <cstddef>
#include <list>

namespace plait::opencl {

class Staging {
  public:
    // What uploads under way may take together before one waits for the oldest of them.
    static constexpr size_t most_bytes = size_t{64} << 20;

    Staging(Context context, cl_device_id device, const Calls& calls)
        : context_(std::move(context)), device_(device), calls_(calls) {}
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;
    ~Staging(); // waits for uploads under way

    // Enqueues a write of `bytes` bytes at `offset`; `src` may go when this returns. `what` names
    // it in errors.
    Status upload(cl_command_queue queue, cl_mem to, size_t offset, size_t bytes, const void* src,
                  const std::string& what);

  private:
    // Page-locked where the driver has such memory: others may wait before they copy.
    struct Slot {
        Memory memory;
        void* host = nullptr;
        size_t size = 0; // bytes
        Event taken;     // none: free
        Queue queue;     // that takes it
    };

    Status free_taken();
    Status make_room(size_t bytes);
    Result<Slot*> slot(size_t bytes);
    Status map(Slot& slot);
    void release(Slot& slot);

    Context context_;
    cl_device_id device_;
    Calls calls_;
    Queue mapping_;         // of its own: a map in the work's queue would wait for the work
    std::list<Slot> slots_; // those under way first, oldest first
    size_t under_way_ = 0;  // bytes
};

} // namespace plait::opencl
