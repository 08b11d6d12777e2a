#include "rig.hpp"

#include "bench.hpp"

namespace bench {
namespace {

// Dispatches between two waits: a frame's worth, so that the wait does not count as the stage.
constexpr size_t dispatches_per_wait = 8;

// Buffers in the lane layout hold floats.
plait_element stored_as(plait_element element) {
    return element == PLAIT_ELEMENT_REAL ? PLAIT_ELEMENT_FLOAT : element;
}

} // namespace

Rig::Rig(Device& device, plait_stage stage, const Shape& shape)
    : device_(device), params_(typical_params(stage, shape)) {
    const plait_stage_info& info = *plait_stage_describe(stage);
    for (uint32_t index = 0; index < info.arg_count; ++index)
        if (const plait_stage_arg& arg = info.args[index]; arg.access != PLAIT_ACCESS_LOCAL)
            add(arg, typical_buffer(info, arg, shape));
    dispatch_ = {stage,
                 item_count(stage, shape),
                 item_width(stage, shape),
                 params_.data(),
                 info.params_size,
                 info.buffer_count,
                 handles_.data(),
                 0};
    run(); // compiles what is compiled at first use
}

double Rig::run() {
    const std::vector<plait_dispatch> list(dispatches_per_wait, dispatch_);
    const auto start = std::chrono::steady_clock::now();
    device_.submit(list);
    device_.wait();
    return seconds_since(start) / dispatches_per_wait;
}

// No contents, no buffer.
void Rig::add(const plait_stage_arg& arg, const std::vector<uint32_t>& contents) {
    if (!contents.empty())
        buffers_.push_back(device_.make(stored_as(arg.element), arg.name, contents));
    handles_.push_back(contents.empty() ? nullptr : buffers_.back().get());
}

} // namespace bench
