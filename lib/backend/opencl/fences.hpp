// Numbers behind the work of a queue, which runs in order.
#pragma once

#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <cstdint>
#include <deque>

namespace plait::opencl {

class Fences {
  public:
    Status make(cl_command_queue queue, uint64_t& fence);
    // Of one that was made; `wait`: until it is.
    Status reached(uint64_t fence, bool wait, bool& reached);

  private:
    Status forget_reached();

    std::deque<Event> markers_; // of the fences after passed_
    uint64_t passed_ = 0;
};

} // namespace plait::opencl
