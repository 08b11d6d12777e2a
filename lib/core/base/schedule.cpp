#include "core/base/schedule.hpp"

#include "base/format.hpp"

#include <algorithm>

namespace plait {
namespace {

constexpr size_t more = 16; // dispatches; a substep takes about ten

} // namespace

void Schedule::add(plait_stage stage, uint32_t items, uint32_t width, const void* params,
                   size_t size, std::initializer_list<const Buffer*> buffers) {
    if (items == 0)
        return;
    assert(buffers.size() <= most_arguments);
    assert(buffers.size() == plait_stage_describe(stage)->buffer_count);
    if (size_ == dispatches_.size()) {
        entries_.resize(size_ + more);
        dispatches_.resize(size_ + more);
    }
    Entry& entry = entries_[size_];
    std::memcpy(entry.params.data(), params, size);
    std::transform(buffers.begin(), buffers.end(), entry.buffers.begin(),
                   [](const Buffer* buffer) { return buffer ? buffer->handle() : nullptr; });
    std::transform(buffers.begin(), buffers.end(), entry.elements.begin(),
                   [](const Buffer* buffer) { return buffer ? buffer->count() : 0; });
    dispatches_[size_++] = {stage,
                            items,
                            width,
                            entry.params.data(),
                            static_cast<uint32_t>(size),
                            static_cast<uint32_t>(buffers.size()),
                            entry.buffers.data(),
                            0};
}

void Schedule::reckon_traffic(uint32_t vertices_per_strand) {
    for (size_t i = 0; i < size_; ++i) {
        plait_dispatch& dispatch = dispatches_[i];
        const bool of_lanes = plait_stage_describe(dispatch.stage)->space == PLAIT_SPACE_LANES;
        dispatch.bytes = plait_stage_traffic(dispatch.stage, dispatch.item_count,
                                             of_lanes ? dispatch.item_width : vertices_per_strand,
                                             entries_[i].elements.data());
    }
}

Status Schedule::submit(Device& device) {
    const auto pending = list();
    clear();
    if (pending.empty())
        return {};
    PLAIT_TRY(check_supported(device, pending));
    return device.submit(pending);
}

Status check_supported(const Device& device, std::span<const plait_dispatch> list) {
    for (const plait_dispatch& dispatch : list)
        if (!device.supports(dispatch.stage))
            return Error{PLAIT_UNSUPPORTED, format("the backend has no stage \"%s\"",
                                                   plait_stage_describe(dispatch.stage)->name)};
    return {};
}

} // namespace plait
