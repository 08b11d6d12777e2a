#include "backend/opencl/range.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <span>
#include <string_view>

namespace plait::opencl {
namespace {

// One work-group's size where nothing else asks for one: a wavefront of AMD, two warps of NVIDIA.
constexpr size_t usual_group = 64;

// Where an item is little work and a group no loop of a CPU core. A multiprocessor holds at most 16
// groups at a time (NVIDIA, compute capability 7.5 and 8.6): of 64 work-items that is 1024, where 8.6
// has room for 1536.
constexpr size_t small_items_group = 256;

// Where a group clears and hands on its sums of the grid, a fixed cost, and its local memory says how
// many of them run at a time: of 64, with a grid of 8^3, two thirds of the warps that the registers of a
// multiprocessor of NVIDIA's have room for (compute capability 8.6), of 128 all of them.
constexpr size_t summing_group = 128;

size_t local_bytes_per_item(const plait_stage_info& stage) {
    size_t bytes = 0;
    for (const plait_stage_arg& arg : std::span(stage.args, stage.arg_count))
        if (arg.access == PLAIT_ACCESS_LOCAL)
            bytes += element_size(arg.element);
    return bytes;
}

// Work-items of one group that fit the device's work-group memory.
size_t items_in_memory(const plait_stage_info& stage, const GroupLimits& limits) {
    const size_t bytes = local_bytes_per_item(stage);
    return bytes == 0 ? SIZE_MAX : static_cast<size_t>(limits.local_memory / bytes);
}

WorkRange ranges_of(size_t groups, size_t local) {
    return {groups * local, local};
}

Result<WorkRange> strand_groups(const plait_stage_info& stage, const plait_dispatch& dispatch,
                                const GroupLimits& limits) {
    const size_t width = dispatch.item_width;
    const size_t kernel_items = limits.advice ? SIZE_MAX : limits.kernel_items;
    const size_t most =
        std::min({limits.device_items, kernel_items, items_in_memory(stage, limits)});
    if (width > most)
        return Error{PLAIT_UNSUPPORTED,
                     format("stage %s: strands of %zu vertices need work-groups of %zu work-items; "
                            "the device allows %zu",
                            stage.name, width, width, most)};
    const size_t wished = std::min({usual_group, limits.kernel_items, most});
    const size_t strands = std::max<size_t>(1, wished / width);
    return ranges_of((dispatch.item_count + strands - 1) / strands, strands * width);
}

WorkRange voxel_groups(const plait_stage_info& stage, const plait_dispatch& dispatch,
                       const GroupLimits& limits) {
    const size_t most =
        std::min({limits.device_items, limits.kernel_items, items_in_memory(stage, limits)});
    size_t width = dispatch.item_width;
    while (width > 1 && width > most)
        width /= 2;
    return ranges_of(dispatch.item_count, width);
}

size_t strand_items(const GroupLimits& limits) {
    return limits.sums ? summing_group : usual_group;
}

// A work-item steps `lanes` strands; where these fill registers, one is a work-group's worth.
WorkRange lane_items(const plait_dispatch& dispatch, const GroupLimits& limits) {
    const size_t tiles = (dispatch.item_count + limits.tile - 1) / limits.tile;
    const size_t items = tiles * (limits.tile / limits.lanes);
    const size_t wished = limits.lanes > 1 ? 1 : strand_items(limits);
    const size_t local = std::min({wished, limits.device_items, limits.kernel_items});
    return ranges_of((items + local - 1) / local, local);
}

} // namespace

bool gives_advice_for_limit(const plait_device_info& info) {
    return std::string_view(info.platform) == "rusticl" &&
           std::string_view(info.driver).starts_with("22.3");
}

size_t element_size(plait_element element) {
    return element == PLAIT_ELEMENT_FLOAT4 ? 4 * sizeof(float) : sizeof(float);
}

Result<WorkRange> work_range(const plait_stage_info& stage, const plait_dispatch& dispatch,
                             const GroupLimits& limits) {
    if (stage.space == PLAIT_SPACE_STRAND_GROUP)
        return strand_groups(stage, dispatch, limits);
    if (stage.space == PLAIT_SPACE_VOXEL_GROUP)
        return voxel_groups(stage, dispatch, limits);
    if (stage.space == PLAIT_SPACE_LANES)
        return lane_items(dispatch, limits);
    const bool small = stage.space == PLAIT_SPACE_VERTEX || stage.space == PLAIT_SPACE_WORD;
    const size_t wished = small && limits.lanes == 1 ? small_items_group : strand_items(limits);
    const size_t local = std::min({wished, limits.device_items, limits.kernel_items});
    return ranges_of((dispatch.item_count + local - 1) / local, local);
}

} // namespace plait::opencl
