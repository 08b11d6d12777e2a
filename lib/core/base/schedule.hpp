// A list of dispatches under construction: what a backend is asked to do next.
#pragma once

#include "backend/device.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <deque>
#include <initializer_list>
#include <memory_resource>
#include <string_view>
#include <vector>

namespace plait {

// Arguments of the stage that has most: a dot for each, counted stage by stage.
#define PLAIT_STAGE(stage, space, params, brief) std::string_view(""
#define PLAIT_ARG(stage, name, element, access) "."
#define PLAIT_STAGE_END(stage) ).size(),
inline constexpr size_t most_arguments = std::max({
#include <plait/stages.def>
    size_t{0}});

// Holds parameters and buffer lists in place and keeps its room, so that stepping does not allocate.
class Schedule {
  public:
    explicit Schedule(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : dispatches_(memory), entries_(memory) {}
    Schedule(const Schedule&) = delete;
    Schedule& operator=(const Schedule&) = delete;

    // Of no items: nothing is added.
    template <typename Params>
    void add(plait_stage stage, uint32_t items, const Params& params,
             std::initializer_list<const Buffer*> buffers, uint32_t width = 1) {
        static_assert(sizeof(Params) <= sizeof(Entry::params));
        add(stage, items, width, &params, sizeof params, buffers);
    }
    void clear() { size_ = 0; }
    // Fills in the bytes that each dispatch of the list moves. `vertices_per_strand`: of those whose
    // item_width does not say it.
    void reckon_traffic(uint32_t vertices_per_strand);
    std::span<const plait_dispatch> list() const { return {dispatches_.data(), size_}; }

    // Hands the list to the device and starts a new one. UNSUPPORTED names the missing stage.
    Status submit(Device& device);

  private:
    struct Entry {
        alignas(16) std::array<unsigned char, 192> params;
        std::array<plait_buffer*, most_arguments> buffers;
        std::array<size_t, most_arguments> elements; // of each buffer
    };

    void add(plait_stage stage, uint32_t items, uint32_t width, const void* params, size_t size,
             std::initializer_list<const Buffer*> buffers);

    size_t size_ = 0;
    std::pmr::vector<plait_dispatch> dispatches_; // of which `size_` are in use
    std::pmr::deque<Entry> entries_;              // which dispatches point into
};

// UNSUPPORTED if the device lacks a stage of the list.
Status check_supported(const Device& device, std::span<const plait_dispatch> list);

} // namespace plait
