// Opening a device: on a context of its own, or on the caller's.
#include "backend/opencl/device.hpp"
#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

#include <plait/plait_opencl.h>

#include <algorithm>

namespace plait::opencl {
namespace {

Result<Session> own_session(const plait_open_info& info, const Log& log) {
    const Candidates found = find_devices();
    for (const std::string& reason : found.rejected)
        log(PLAIT_LOG_LEVEL_INFO, "opencl: passed over " + reason);
    if (info.device_index >= found.usable.size())
        return Error{PLAIT_NOT_FOUND, format("device %u: there are %zu OpenCL devices",
                                             info.device_index, found.usable.size())};
    const Candidate& candidate = found.usable[info.device_index];
    auto programs = Programs::of_device(candidate);
    PLAIT_TRY(programs);
    cl_int code = CL_SUCCESS;
    Queue queue(clCreateCommandQueue((*programs)->context(), candidate.device,
                                     info.profile ? CL_QUEUE_PROFILING_ENABLE : 0, &code));
    if (code != CL_SUCCESS)
        return failure(code, format("clCreateCommandQueue on %s", candidate.info.name));
    return Session{candidate, std::move(*programs), std::move(queue), info.profile != 0};
}

Result<cl_command_queue_properties> check_handles(const plait_opencl_handles& handles) {
    const auto refuse = [](const char* why) { return Error{PLAIT_INVALID_ARGUMENT, why}; };
    if (!handles.context || !handles.device || !handles.queue)
        return refuse("plait_opencl_handles: context, device and queue must all be set");
    cl_context context = nullptr;
    cl_device_id device = nullptr;
    cl_command_queue_properties properties = 0;
    const auto get = [&](cl_command_queue_info what, size_t size, void* value) {
        return clGetCommandQueueInfo(handles.queue, what, size, value, nullptr);
    };
    for (const cl_int code : {get(CL_QUEUE_CONTEXT, sizeof(cl_context), &context),
                              get(CL_QUEUE_DEVICE, sizeof(cl_device_id), &device),
                              get(CL_QUEUE_PROPERTIES, sizeof properties, &properties)})
        if (code != CL_SUCCESS)
            return Error{PLAIT_INVALID_ARGUMENT,
                         "plait_opencl_handles: the queue: " + error_name(code)};
    if (context != handles.context)
        return refuse("plait_opencl_handles: the queue belongs to another context");
    if (device != handles.device)
        return refuse("plait_opencl_handles: the queue belongs to another device");
    if (properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE)
        return refuse("plait_opencl_handles: the queue is out of order; plait needs one in order");
    return properties;
}

Result<Session> adopted_session(const plait_open_info& info, const Log& log) {
    const auto& handles = *static_cast<const plait_opencl_handles*>(info.native);
    const auto properties = check_handles(handles);
    PLAIT_TRY(properties);
    auto candidate = examine_device(handles.device);
    PLAIT_TRY(candidate);
    const bool can_profile = *properties & CL_QUEUE_PROFILING_ENABLE;
    if (info.profile && !can_profile)
        log(PLAIT_LOG_LEVEL_WARNING,
            "opencl: the adopted queue was made without CL_QUEUE_PROFILING_ENABLE: "
            "stage times will be 0");
    return Session{*candidate, std::make_shared<Programs>(Context::share(handles.context)),
                   Queue::share(handles.queue), info.profile && can_profile};
}

std::string stage_names() {
    std::string list;
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage)
        list += format("%s%s", stage ? ", " : "",
                       plait_stage_describe(static_cast<plait_stage>(stage))->name);
    return list;
}

const plait_stage_info* find_stage(const char* name) {
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        const plait_stage_info* info = plait_stage_describe(static_cast<plait_stage>(stage));
        if (name && std::string(name) == info->name)
            return info;
    }
    return nullptr;
}

} // namespace

// The user's own kernels are built at once, so that what is wrong with them is told now.
Status Device::take_sources(std::span<const plait_stage_source> sources) {
    for (const plait_stage_source& source : sources) {
        const plait_stage_info* stage = find_stage(source.stage);
        if (!stage)
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("stage_sources[%td].stage is \"%s\"; the stages are %s",
                                &source - sources.data(), source.stage ? source.stage : "(null)",
                                stage_names().c_str())};
        if (!source.source)
            return Error{PLAIT_INVALID_ARGUMENT, format("stage_sources[%td] (%s): source is null",
                                                        &source - sources.data(), stage->name)};
        texts_[stage->stage] = {source.name ? source.name : format("<%s>", stage->name),
                                source.source, true};
        own_texts_.set(stage->stage);
        PLAIT_TRY(kernel(*stage, {}));
    }
    keep_changed();
    return {};
}

Result<std::unique_ptr<Device>> Device::open(const plait_open_info& info, const Calls& calls) {
    const Log log{info.log, info.log_user};
    auto session = info.native ? adopted_session(info, log) : own_session(info, log);
    PLAIT_TRY(session);
    if (info.lanes != 0)
        PLAIT_TRY(set_lanes(session->candidate.info, info.lanes));
    ProgramFolder folder;
    if (info.program_folder) {
        auto opened = ProgramFolder::open(info.program_folder);
        PLAIT_TRY(opened);
        folder = std::move(*opened);
    }
    std::unique_ptr<Device> device(new Device(std::move(*session), log, calls, std::move(folder)));
    PLAIT_TRY(device->take_sources({info.stage_sources, info.stage_source_count}));
    log(PLAIT_LOG_LEVEL_INFO,
        format("opencl: opened %s (%s), driver %s%s", device->info().name, device->info().platform,
               device->info().driver, info.native ? ", on the caller's queue" : ""));
    return device;
}

} // namespace plait::opencl
