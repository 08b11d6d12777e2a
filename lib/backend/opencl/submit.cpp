// Lists of stages onto the queue.
#include "backend/opencl/device.hpp"
#include "backend/opencl/errors.hpp"
#include "base/format.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace plait::opencl {
namespace {

// Work-items from which on PoCL compiles a kernel anew, for ids that take more bits.
constexpr size_t usual_grid = 65535;

Status check(const plait_stage_info& stage, const plait_dispatch& dispatch) {
    if (dispatch.params_size != stage.params_size || !dispatch.params)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("stage %s: parameters of %u bytes, %s has %u", stage.name,
                            dispatch.params_size, stage.params_type, stage.params_size)};
    if (dispatch.buffer_count != stage.buffer_count)
        return Error{PLAIT_INVALID_ARGUMENT, format("stage %s: %u buffers, it has %u", stage.name,
                                                    dispatch.buffer_count, stage.buffer_count)};
    if (stage.space == PLAIT_SPACE_LANES && dispatch.item_width < PLAIT_MIN_VERTICES)
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("stage %s: item_width %u, vertices per strand of at least %d are needed",
                   stage.name, dispatch.item_width, PLAIT_MIN_VERTICES)};
    if (dispatch.item_width == 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("stage %s: item_width 0, at least 1 is needed", stage.name)};
    return {};
}

// Sets a kernel's arguments in order, so that no index is written down anywhere.
class ArgumentList {
  public:
    explicit ArgumentList(cl_kernel kernel) : kernel_(kernel) {}

    void value(const void* bytes, size_t size) {
        const cl_int code = clSetKernelArg(kernel_, index_++, size, bytes);
        if (code_ == CL_SUCCESS)
            code_ = code;
    }
    void memory(cl_mem memory) { value(memory ? &memory : nullptr, sizeof(cl_mem)); }
    void local(size_t size) { value(nullptr, size); }
    cl_int code() const { return code_; }

  private:
    cl_kernel kernel_;
    cl_uint index_ = 0;
    cl_int code_ = CL_SUCCESS;
};

Status set_arguments(cl_kernel kernel, const plait_stage_info& stage,
                     const plait_dispatch& dispatch, size_t local_items) {
    ArgumentList arguments(kernel);
    arguments.value(&dispatch.item_count, sizeof dispatch.item_count);
    arguments.value(dispatch.params, dispatch.params_size);
    plait_buffer* const* next = dispatch.buffers;
    for (const plait_stage_arg& arg : std::span(stage.args, stage.arg_count)) {
        if (arg.access == PLAIT_ACCESS_LOCAL) {
            arguments.local(local_items * element_size(arg.element));
            continue;
        }
        const auto* buffer = reinterpret_cast<const Buffer*>(*next++);
        arguments.memory(buffer ? buffer->memory.get() : nullptr);
    }
    if (arguments.code() != CL_SUCCESS)
        return failure(arguments.code(), format("stage %s: clSetKernelArg", stage.name));
    return {};
}

} // namespace

Result<WorkRange> Device::range_of(const plait_stage_info& stage, const plait_dispatch& dispatch,
                                   const StageKernel& built) const {
    return work_range(stage, dispatch,
                      {info().max_group_size, built.group_limit, info().local_memory_bytes,
                       info().lanes, info().tile, gives_advice_for_limit(info()),
                       variant_of(stage, dispatch).group_sums > 0});
}

Status Device::enqueue(const plait_dispatch& dispatch, bool last) {
    const plait_stage_info* stage = plait_stage_describe(dispatch.stage);
    if (!stage)
        return Error{PLAIT_INVALID_ARGUMENT, format("stage %d does not exist", dispatch.stage)};
    PLAIT_TRY(check(*stage, dispatch));
    auto found = kernel(*stage, variant_of(*stage, dispatch));
    PLAIT_TRY(found);
    const StageKernel& built = **found;
    const auto range = range_of(*stage, dispatch, built);
    PLAIT_TRY(range);
    PLAIT_TRY(set_arguments(built.kernel.get(), *stage, dispatch, (*range).local));

    // Without profiling one event per list is enough to learn whether its commands failed.
    cl_event event = nullptr;
    const bool watch = session_.profile || last;
    PLAIT_TRY(launch(*stage, built, *range, watch ? &event : nullptr));
    flight_.count(dispatch.stage);
    if (watch)
        flight_.add(Event(event), dispatch);
    return {};
}

Status Device::launch(const plait_stage_info& stage, const StageKernel& built,
                      const WorkRange& range, cl_event* event) const {
    const cl_int code = calls_.enqueue_kernel(work_queue(), built.kernel.get(), 1, nullptr,
                                              &range.global, &range.local, 0, nullptr, event);
    if (code != CL_SUCCESS)
        return failure(code, format("stage %s: clEnqueueNDRangeKernel of %zu work-items in groups "
                                    "of %zu",
                                    stage.name, range.global, range.local));
    return {};
}

// Drivers compile for a work-group's size, and load, when a kernel is first enqueued: it is, over
// no items, for the range that it will have. A kernel of the user's might not look at item_count.
Status Device::warm_up(const plait_dispatch& dispatch) {
    const plait_stage_info* stage = plait_stage_describe(dispatch.stage);
    if (!stage)
        return Error{PLAIT_INVALID_ARGUMENT, format("stage %d does not exist", dispatch.stage)};
    const auto found = kernel(*stage, variant_of(*stage, dispatch));
    PLAIT_TRY(found);
    if (dispatch.item_count == 0 || own_texts_.test(dispatch.stage))
        return {};
    const auto range = range_of(*stage, dispatch, **found);
    PLAIT_TRY(range);
    if (!warm_.emplace(*found, (*range).global > usual_grid).second)
        return {};
    changed_.push_back(*found);
    const std::vector<plait_buffer*> none(stage->buffer_count, nullptr);
    // kernels divide by counts before they look at item_count
    const std::vector<uint32_t> ones(stage->params_size / sizeof(uint32_t), 1);
    plait_dispatch empty = dispatch;
    empty.item_count = 0;
    empty.buffers = none.data();
    empty.params = dispatch.params ? dispatch.params : ones.data();
    empty.params_size = stage->params_size;
    PLAIT_TRY(set_arguments((*found)->kernel.get(), *stage, empty, (*range).local));
    return launch(*stage, **found, *range, nullptr);
}

Status Device::prepare(std::span<const plait_dispatch> list) {
    const size_t before = warm_.size();
    for (const plait_dispatch& dispatch : list)
        PLAIT_TRY(warm_up(dispatch));
    return warm_.size() == before ? Status{} : finish();
}

// Drivers add to a program what they compile when its kernels first run, and PoCL gives its binary but
// once: when all that is prepared together has run.
void Device::keep_changed() {
    std::set<std::string> kept;
    for (const StageKernel* built : std::exchange(changed_, {}))
        if (kept.insert(built->key).second)
            keep_program(folder_, built->key, built->program.get(), session_.candidate.device,
                         log_);
}

Status Device::submit(std::span<const plait_dispatch> list) {
    PLAIT_TRY(flight_.collect(session_.profile));
    for (const plait_dispatch& dispatch : list)
        if (dispatch.item_count > 0)
            PLAIT_TRY(enqueue(dispatch, &dispatch == &list.back()));
    if (side_queues_.open())
        return {}; // flushed with all the others when they end
    if (const cl_int code = calls_.flush(queue()))
        return late_failure(code, "clFlush");
    return {};
}

// With profiling all is one sequence: what a launch takes beside others is not its own time.
Status Device::overlap(plait_overlap what) {
    if (session_.profile)
        return {};
    if (what == PLAIT_OVERLAP_BEGIN)
        return side_queues_.begin(queue());
    return what == PLAIT_OVERLAP_NEXT ? side_queues_.next() : side_queues_.end(queue());
}

} // namespace plait::opencl
