// Sequences of work that need not wait for each other, on queues of their own beside the device's:
// a driver runs the commands of one in-order queue one after another, however little of the device
// each of them fills.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace plait::opencl {

class SideQueues {
  public:
    // A queue for each compute unit that would be idle, as long as there are few: a GPU has units
    // by the hundred, and takes a handful of queues at once.
    static constexpr uint32_t least = 2, most = 16;

    SideQueues(Context context, cl_device_id device, uint32_t compute_units, const Calls& calls);

    // Opens them: each begins behind what is on `main`.
    Status begin(cl_command_queue main);
    // The sequence that follows goes on the next of them, and behind what is there.
    Status next();
    // Closes them: what follows on `main` is behind all of them. Flushes each of them once.
    Status end(cl_command_queue main);

    bool open() const { return static_cast<bool>(begun_); }
    cl_command_queue queue() const { return queues_[at_].get(); } // while they are open
    size_t size() const { return queues_.size(); }                // that were made so far

  private:
    Status enter(size_t index);
    Status join(cl_command_queue main);

    Context context_;
    cl_device_id device_;
    size_t count_;
    Calls calls_;
    std::vector<Queue> queues_; // made when they are first needed
    Event begun_;               // behind what `main` held; none: closed
    size_t at_ = 0;             // the present one
    size_t used_ = 0;           // since begin()
};

} // namespace plait::opencl
