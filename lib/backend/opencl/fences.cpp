#include "backend/opencl/fences.hpp"

#include "backend/opencl/errors.hpp"

#include <utility>

namespace plait::opencl {

Status Fences::make(cl_command_queue queue, uint64_t& fence) {
    PLAIT_TRY(forget_reached()); // else a caller that never asks would fill memory
    cl_event marker = nullptr;
    if (const cl_int code = clEnqueueMarkerWithWaitList(queue, 0, nullptr, &marker))
        return late_failure(code, "clEnqueueMarkerWithWaitList");
    markers_.emplace_back(marker);
    fence = passed_ + markers_.size();
    return {};
}

Status Fences::reached(uint64_t fence, bool wait, bool& reached) {
    if (wait && fence > passed_) {
        const cl_event marker = markers_[static_cast<size_t>(fence - passed_ - 1)].get();
        if (const cl_int code = clWaitForEvents(1, &marker))
            return late_failure(code, "waiting for a fence");
    }
    PLAIT_TRY(forget_reached());
    reached = fence <= passed_;
    return {};
}

Status Fences::forget_reached() {
    while (!markers_.empty()) {
        cl_int status = CL_QUEUED;
        if (const cl_int code =
                clGetEventInfo(markers_.front().get(), CL_EVENT_COMMAND_EXECUTION_STATUS,
                               sizeof status, &status, nullptr))
            return late_failure(code, "clGetEventInfo");
        if (status > CL_COMPLETE)
            return {};
        markers_.pop_front();
        ++passed_;
        if (status < 0)
            return late_failure(status, "work before a fence");
    }
    return {};
}

} // namespace plait::opencl
