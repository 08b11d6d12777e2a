#include "backend/opencl/side_queues.hpp"

#include "backend/opencl/errors.hpp"

#include <algorithm>

namespace plait::opencl {

SideQueues::SideQueues(Context context, cl_device_id device, uint32_t compute_units,
                       const Calls& calls)
    : context_(std::move(context)), device_(device), count_(std::clamp(compute_units, least, most)),
      calls_(calls) {
    queues_.reserve(count_);
}

Status SideQueues::begin(cl_command_queue main) {
    cl_event begun = nullptr;
    if (const cl_int code = clEnqueueMarkerWithWaitList(main, 0, nullptr, &begun))
        return late_failure(code, "clEnqueueMarkerWithWaitList");
    begun_ = Event(begun);
    // By the standard, before another queue waits for it.
    Status status;
    if (const cl_int code = calls_.flush(main))
        status = late_failure(code, "clFlush");
    used_ = 0;
    if (status)
        status = enter(0);
    if (!status)
        begun_ = {};
    return status;
}

Status SideQueues::next() {
    return open() ? enter((at_ + 1) % count_) : Status{};
}

Status SideQueues::enter(size_t index) {
    if (index == queues_.size()) {
        cl_int code = CL_SUCCESS;
        Queue made(clCreateCommandQueue(context_.get(), device_, 0, &code));
        if (code != CL_SUCCESS)
            return failure(code, "clCreateCommandQueue of sequences that overlap");
        queues_.push_back(std::move(made));
    }
    at_ = index;
    if (index < used_)
        return {};
    used_ = index + 1;
    const cl_event begun = begun_.get();
    if (const cl_int code = clEnqueueBarrierWithWaitList(queue(), 1, &begun, nullptr))
        return late_failure(code, "clEnqueueBarrierWithWaitList");
    return {};
}

Status SideQueues::end(cl_command_queue main) {
    if (!open())
        return {};
    Status status = join(main);
    begun_ = {};
    return status;
}

Status SideQueues::join(cl_command_queue main) {
    std::vector<Event> ends;
    std::vector<cl_event> list;
    for (size_t index = 0; index < used_; ++index) {
        cl_event end = nullptr;
        if (const cl_int code = clEnqueueMarkerWithWaitList(queues_[index].get(), 0, nullptr, &end))
            return late_failure(code, "clEnqueueMarkerWithWaitList");
        ends.emplace_back(end);
        list.push_back(end);
        if (const cl_int code = calls_.flush(queues_[index].get()))
            return late_failure(code, "clFlush");
    }
    if (const cl_int code = clEnqueueBarrierWithWaitList(main, static_cast<cl_uint>(list.size()),
                                                         list.data(), nullptr))
        return late_failure(code, "clEnqueueBarrierWithWaitList");
    if (const cl_int code = calls_.flush(main))
        return late_failure(code, "clFlush");
    return {};
}

} // namespace plait::opencl
