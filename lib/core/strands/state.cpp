#include "core/strands/state.hpp"

#include "core/base/polyline.hpp"
#include "core/groom/groom.hpp"

#include <algorithm>
#include <vector>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

std::pmr::vector<float> edge_lengths(const Groom& groom, const Layout& layout,
                                     std::pmr::memory_resource* memory) {
    std::pmr::vector<float> lengths(layout.guide_vertices(), 0.0f, memory);
    const float* p = groom.strands.positions.data();
    for (uint32_t strand = 0; strand < layout.guides; ++strand, p += 3)
        for (uint32_t i = 0; i + 1 < groom.strands.vertex_counts[strand]; ++i, p += 3)
            lengths[strand * layout.row + i] =
                static_cast<float>(distance({p[0], p[1], p[2]}, {p[3], p[4], p[5]}));
    return lengths;
}

// Guides' counts, then those of a map's strands, or each guide's again for its follows.
std::pmr::vector<uint32_t> row_counts(const Groom& groom, const Layout& layout,
                                      std::span<const uint32_t> follows,
                                      std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> counts(groom.strands.vertex_counts, memory);
    counts.reserve(layout.strands());
    if (!follows.empty()) {
        counts.insert(counts.end(), follows.begin(), follows.end());
        return counts;
    }
    const uint32_t follows_per_guide = layout.follows / layout.guides;
    for (uint32_t guide = 0; guide < layout.guides; ++guide)
        counts.insert(counts.end(), follows_per_guide, groom.strands.vertex_counts[guide]);
    return counts;
}

std::pmr::vector<Float4> identity_poses(const Layout& layout, std::pmr::memory_resource* memory) {
    std::pmr::vector<Float4> poses(size_t{2} * layout.guides, Float4{}, memory);
    for (size_t i = 0; i < poses.size(); i += 2)
        poses[i][3] = 1;
    return poses;
}

} // namespace

std::pmr::vector<Float4> pad_rows(std::span<const float> positions,
                                  std::span<const uint32_t> vertex_counts, uint32_t row,
                                  uint32_t pinned, std::pmr::memory_resource* memory) {
    std::pmr::vector<Float4> rows(memory);
    rows.reserve(vertex_counts.size() * row);
    const float* strand = positions.data();
    for (const uint32_t count : vertex_counts) {
        for (uint32_t i = 0; i < row; ++i) {
            const float* p = strand + size_t{3} * std::min(i, count - 1);
            rows.push_back({p[0], p[1], p[2], i < pinned ? 0.0f : 1.0f});
        }
        strand += size_t{3} * count;
    }
    return rows;
}

Result<State> create_state(Device& device, const Groom& groom, const Layout& layout,
                           const StateNeeds& needs, std::pmr::memory_resource* memory) {
    State state;
    const auto make = [&](Buffer& to, plait_element element, size_t count, const char* name,
                          const void* content, size_t content_count) -> Status {
        PLAIT_TRY(device.create(to, element, count, name));
        return device.write(to, 0, content_count, content);
    };
    const auto rest = pad_rows(groom.strands.positions, groom.strands.vertex_counts, layout.row,
                               needs.pinned, memory);
    const size_t guides = rest.size();
    const size_t display = size_t{needs.position_rows} * layout.row;
    const auto lengths = edge_lengths(groom, layout, memory);
    const auto counts = row_counts(groom, layout, needs.follow_counts, memory);
    const auto poses = identity_poses(layout, memory);
    constexpr auto f4 = PLAIT_ELEMENT_FLOAT4;
    PLAIT_TRY(make(state.rest, f4, guides, "rest", rest.data(), guides));
    PLAIT_TRY(make(state.vertex_count, PLAIT_ELEMENT_UINT, counts.size(), "vertex_count",
                   counts.data(), counts.size()));
    PLAIT_TRY(make(state.rest_length, PLAIT_ELEMENT_FLOAT, guides, "rest_length", lengths.data(),
                   guides));
    PLAIT_TRY(make(state.position, f4, display, "position", rest.data(), guides));
    PLAIT_TRY(make(state.position_prev, f4, guides, "position_prev", rest.data(), guides));
    if (needs.two_steps)
        PLAIT_TRY(make(state.position_prev2, f4, guides, "position_prev2", rest.data(), guides));
    PLAIT_TRY(make(state.pose, f4, poses.size(), "pose", poses.data(), poses.size()));
    return state;
}

Status make_rows(Device& device, const Layout& layout, Buffer& to, const char* name,
                 std::pmr::memory_resource* memory) {
    const std::pmr::vector<Float4> none(layout.guide_vertices(), Float4{}, memory);
    PLAIT_TRY(device.create(to, PLAIT_ELEMENT_FLOAT4, none.size(), name));
    return device.write(to, none.data());
}

} // namespace plait
