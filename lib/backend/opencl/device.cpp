#include "backend/opencl/device.hpp"

#include "backend/opencl/errors.hpp"
#include "backend/opencl/group_sums.hpp"
#include "backend/opencl/program_text.hpp"
#include "base/format.hpp"

namespace plait::opencl {
namespace {

Status check_part(const Buffer& buffer, size_t first, size_t count, const char* what) {
    if (first <= buffer.count && count <= buffer.count - first)
        return {};
    return Error{PLAIT_INVALID_ARGUMENT,
                 format("%s buffer %s: elements %zu to %zu of %zu", what, buffer.name.c_str(),
                        first, first + count, buffer.count)};
}

} // namespace

Device::Device(Session session, Log log, const Calls& calls, ProgramFolder folder)
    : session_(std::move(session)), log_(log), folder_(std::move(folder)), calls_(calls),
      staging_(Context::share(session_.programs->context()), session_.candidate.device, calls),
      side_queues_(Context::share(session_.programs->context()), session_.candidate.device,
                   session_.candidate.info.compute_units, calls) {
    for (int stage = 0; stage < PLAIT_STAGE_COUNT; ++stage) {
        auto text = program_text(static_cast<plait_stage>(stage));
        if (!text.text.empty())
            texts_[static_cast<size_t>(stage)] = std::move(text);
    }
}

// What no call waited for since.
Device::~Device() {
    try {
        keep_changed();
    } catch (...) { // no memory for it: they are not kept
    }
}

bool Device::supports(plait_stage stage) const {
    return stage >= 0 && stage < PLAIT_STAGE_COUNT && texts_[stage].has_value();
}

// A kernel of the user's knows nothing of local memory.
Variant Device::variant_of(const plait_stage_info& stage, const plait_dispatch& dispatch) const {
    Variant variant;
    if (stage.space == PLAIT_SPACE_LANES)
        variant.vertices = dispatch.item_width;
    if (own_texts_.test(stage.stage))
        return variant;
    variant.group_sums = group_sums(dispatch, info());
    return variant;
}

Result<const StageKernel*> Device::kernel(const plait_stage_info& stage, const Variant& variant) {
    const auto key = std::pair(stage.stage, variant);
    auto found = kernels_.find(key);
    if (found == kernels_.end()) {
        if (!texts_[stage.stage])
            return Error{PLAIT_UNSUPPORTED, format("stage %s has no kernel", stage.name)};
        auto built = build_stage(*session_.programs, session_.candidate, stage,
                                 *texts_[stage.stage], log_, folder_, variant);
        PLAIT_TRY(built);
        found = kernels_.emplace(key, std::move(*built)).first;
        changed_.push_back(&found->second);
    }
    return &found->second;
}

Result<std::unique_ptr<Buffer>> Device::create(const plait_buffer_desc& desc) {
    const size_t element = element_size(desc.element);
    const std::string name = desc.name ? desc.name : "(unnamed)";
    const std::string what =
        format("buffer %s of %zu x %zu bytes", name.c_str(), desc.count, element);
    if (desc.count == 0)
        return Error{PLAIT_INVALID_ARGUMENT, what + ": the count must be at least 1"};
    if (desc.count > SIZE_MAX / element)
        return Error{PLAIT_OUT_OF_MEMORY, what + ": larger than the address space"};
    cl_int code = CL_SUCCESS;
    Memory memory(calls_.create_buffer(session_.programs->context(), CL_MEM_READ_WRITE,
                                       desc.count * element, nullptr, &code));
    if (code == CL_OUT_OF_RESOURCES)
        code = CL_MEM_OBJECT_ALLOCATION_FAILURE; // the only resource asked for is memory
    if (code != CL_SUCCESS)
        return failure(code, what);
    return std::make_unique<Buffer>(Buffer{std::move(memory), name, desc.count, element});
}

Status Device::write(const Buffer& buffer, size_t first, size_t count, const void* src) {
    PLAIT_TRY(check_part(buffer, first, count, "write to"));
    if (count == 0)
        return {};
    const cl_int code =
        calls_.enqueue_write(queue(), buffer.memory.get(), CL_TRUE, first * buffer.element_bytes,
                             count * buffer.element_bytes, src, 0, nullptr, nullptr);
    if (code != CL_SUCCESS)
        return late_failure(code, "write to buffer " + buffer.name);
    return flight_.collect(session_.profile);
}

Status Device::upload(const Buffer& buffer, size_t first, size_t count, const void* src) {
    PLAIT_TRY(check_part(buffer, first, count, "write to"));
    if (count == 0)
        return {};
    return staging_.upload(work_queue(), buffer.memory.get(), first * buffer.element_bytes,
                           count * buffer.element_bytes, src, "write to buffer " + buffer.name);
}

Status Device::enqueue_read(const Buffer& buffer, size_t first, size_t count, void* dst,
                            cl_bool blocking) {
    PLAIT_TRY(check_part(buffer, first, count, "read from"));
    if (count == 0)
        return {};
    const cl_int code =
        calls_.enqueue_read(queue(), buffer.memory.get(), blocking, first * buffer.element_bytes,
                            count * buffer.element_bytes, dst, 0, nullptr, nullptr);
    return code == CL_SUCCESS ? Status{} : late_failure(code, "read from buffer " + buffer.name);
}

Status Device::read(const Buffer& buffer, size_t first, size_t count, void* dst) {
    PLAIT_TRY(enqueue_read(buffer, first, count, dst, CL_TRUE));
    return flight_.collect(session_.profile);
}

Status Device::fence(uint64_t& fence) {
    PLAIT_TRY(fences_.make(queue(), fence));
    if (const cl_int code = calls_.flush(queue())) // else nothing before it need ever begin
        return late_failure(code, "clFlush");
    return {};
}

Status Device::fence_reached(uint64_t fence, bool wait, bool& reached) {
    PLAIT_TRY(fences_.reached(fence, wait, reached));
    return reached ? flight_.collect(session_.profile) : Status{};
}

Status Device::wait() {
    PLAIT_TRY(finish());
    keep_changed();
    return {};
}

Status Device::finish() {
    // The clFinish of Mesa 22.3 waits for what has not been flushed, and for nothing else: a
    // marker, which every command before it must end for.
    if (const cl_int code = clEnqueueMarkerWithWaitList(queue(), 0, nullptr, nullptr))
        return late_failure(code, "clEnqueueMarkerWithWaitList");
    if (const cl_int code = calls_.finish(queue()))
        return late_failure(code, "waiting for the device");
    return flight_.collect(session_.profile);
}

Status Device::costs(plait_stage_cost* dst, bool reset) {
    PLAIT_TRY(wait());
    std::ranges::copy(flight_.costs(), dst);
    if (reset)
        flight_.reset_costs();
    return {};
}

Status Device::take_launches(plait_stage_launch* dst, size_t& count) {
    if (!dst)
        PLAIT_TRY(wait());
    flight_.take_launches(dst, count);
    return {};
}

plait_result Device::report(const Status& status) {
    if (status.ok())
        return PLAIT_OK;
    const Error& error = status.error();
    if (error.code == PLAIT_DEVICE_LOST && !lost_) {
        lost_ = error;
        session_.programs->abandon();
    }
    last_error_ = error.message;
    return error.code;
}

} // namespace plait::opencl
