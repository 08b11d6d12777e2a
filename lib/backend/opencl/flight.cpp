#include "backend/opencl/flight.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

namespace plait::opencl {
namespace {

double seconds(cl_event event) {
    cl_ulong start = 0, end = 0; // ns
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr);
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr);
    return end > start ? static_cast<double>(end - start) * 1e-9 : 0.0;
}

} // namespace

Status Flight::take(const Command& command, cl_int status, bool profile) {
    if (status < 0)
        return late_failure(status, format("stage %s ended with an error",
                                           plait_stage_describe(command.stage)->name));
    if (profile)
        costs_[command.stage].seconds += seconds(command.event.get());
    return {};
}

Status Flight::collect(bool profile) {
    while (!events_.empty()) {
        cl_int status = CL_QUEUED;
        const cl_int code =
            clGetEventInfo(events_.front().event.get(), CL_EVENT_COMMAND_EXECUTION_STATUS,
                           sizeof status, &status, nullptr);
        if (code != CL_SUCCESS)
            return late_failure(code, "clGetEventInfo");
        if (status > CL_COMPLETE)
            return {};
        const Command ended = std::move(events_.front());
        events_.pop_front();
        PLAIT_TRY(take(ended, status, profile));
    }
    return {};
}

} // namespace plait::opencl
