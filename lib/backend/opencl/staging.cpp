#include "backend/opencl/staging.hpp"

#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

namespace plait::opencl {
namespace {

constexpr size_t least_slot = 4096; // bytes

} // namespace

Staging::~Staging() {
    for (Slot& slot : slots_)
        release(slot);
    if (mapping_)
        clFinish(mapping_.get());
}

void Staging::release(Slot& slot) {
    if (cl_event taken = slot.taken.get())
        clWaitForEvents(1, &taken);
    clEnqueueUnmapMemObject(mapping_.get(), slot.memory.get(), slot.host, 0, nullptr, nullptr);
}

// Events of one queue end in order, so the first that has not ends the search; those of side queues
// wait here for the oldest of all.
Status Staging::free_taken() {
    while (!slots_.empty() && slots_.front().taken) {
        cl_int status = CL_QUEUED;
        const cl_int code =
            clGetEventInfo(slots_.front().taken.get(), CL_EVENT_COMMAND_EXECUTION_STATUS,
                           sizeof status, &status, nullptr);
        if (code != CL_SUCCESS)
            return late_failure(code, "clGetEventInfo of an upload");
        if (status > CL_COMPLETE)
            return {};
        slots_.front().taken = {};
        slots_.front().queue = {};
        under_way_ -= slots_.front().size;
        slots_.splice(slots_.end(), slots_, slots_.begin());
        if (status < 0)
            return late_failure(status, "an upload ended with an error");
    }
    return {};
}

Status Staging::make_room(size_t bytes) {
    PLAIT_TRY(free_taken());
    while (under_way_ > 0 && bytes > most_bytes - std::min(most_bytes, under_way_)) {
        if (const cl_int code = calls_.flush(slots_.front().queue.get()))
            return late_failure(code, "clFlush");
        cl_event oldest = slots_.front().taken.get();
        if (const cl_int code = clWaitForEvents(1, &oldest))
            return late_failure(code, "waiting for an upload");
        PLAIT_TRY(free_taken());
    }
    return {};
}

Status Staging::map(Slot& slot) {
    cl_int code = CL_SUCCESS;
    if (!mapping_)
        mapping_ = Queue(clCreateCommandQueue(context_.get(), device_, 0, &code));
    if (code != CL_SUCCESS)
        return failure(code, "clCreateCommandQueue for uploads");
    slot.memory = Memory(calls_.create_buffer(
        context_.get(), CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, slot.size, nullptr, &code));
    if (code == CL_SUCCESS)
        slot.host = clEnqueueMapBuffer(mapping_.get(), slot.memory.get(), CL_TRUE,
                                       CL_MAP_READ | CL_MAP_WRITE, 0, slot.size, 0, nullptr,
                                       nullptr, &code);
    if (code != CL_SUCCESS)
        return failure(code, format("%zu bytes of host memory for uploads", slot.size));
    return {};
}

// A free slot of at least so many bytes; a free one that is too small gives way to a larger.
Result<Staging::Slot*> Staging::slot(size_t bytes) {
    const auto fits = [&](const Slot& s) { return !s.taken && s.size >= bytes; };
    if (const auto found = std::ranges::find_if(slots_, fits); found != slots_.end())
        return &*found;
    Slot made;
    made.size = std::bit_ceil(std::max(bytes, least_slot));
    PLAIT_TRY(map(made));
    if (!slots_.empty() && !slots_.back().taken) {
        release(slots_.back());
        slots_.pop_back();
    }
    return &slots_.emplace_back(std::move(made));
}

Status Staging::upload(cl_command_queue queue, cl_mem to, size_t offset, size_t bytes,
                       const void* src, const std::string& what) {
    PLAIT_TRY(make_room(bytes));
    auto found = slot(bytes);
    PLAIT_TRY(found);
    Slot& free = **found;
    std::memcpy(free.host, src, bytes);
    cl_event event = nullptr;
    const cl_int code =
        calls_.enqueue_write(queue, to, CL_FALSE, offset, bytes, free.host, 0, nullptr, &event);
    if (code != CL_SUCCESS)
        return late_failure(code, what);
    free.taken = Event(event);
    free.queue = Queue::share(queue);
    under_way_ += free.size;
    // Behind those under way, ahead of the free ones.
    const auto at = std::ranges::find_if(slots_, [&](const Slot& s) { return &s == &free; });
    const auto first_free =
        std::ranges::find_if(slots_, [&](const Slot& s) { return &s == &free || !s.taken; });
    slots_.splice(first_free, slots_, at);
    return {};
}

} // namespace plait::opencl
