#include "backend/opencl/flight.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

namespace plait::opencl {
namespace {

// ns; 0 where the driver tells none.
cl_ulong time_of(cl_event event, cl_profiling_info moment) {
    cl_ulong time = 0;
    const cl_int code = clGetEventProfilingInfo(event, moment, sizeof time, &time, nullptr);
    return code == CL_SUCCESS ? time : 0;
}

} // namespace

Status Flight::take(const Command& command, cl_int status, bool profile) {
    if (status < 0)
        return late_failure(status, format("stage %s ended with an error",
                                           plait_stage_describe(command.launch.stage)->name));
    if (profile)
        record(command);
    return {};
}

void Flight::record(const Command& command) {
    plait_stage_launch launch = command.launch;
    const cl_ulong begin = time_of(command.event.get(), CL_PROFILING_COMMAND_START);
    const cl_ulong end = time_of(command.event.get(), CL_PROFILING_COMMAND_END);
    // No launch takes one: rusticl of Mesa 22.3 only numbers its moments, 0 to 3.
    constexpr cl_ulong least = 2; // ns
    if (end >= begin + least) {
        launch.queued_ns = time_of(command.event.get(), CL_PROFILING_COMMAND_QUEUED);
        launch.begin_ns = begin;
        launch.end_ns = end;
        costs_[launch.stage].seconds += static_cast<double>(end - begin) * 1e-9;
    }
    launches_.add(launch);
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
