#include "core/follows/follow_turns.hpp"

#include "core/base/strand_order.hpp"
#include "core/follows/follow_places.hpp"

#include <vector>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

// Of the segment before each vertex, in each of the strand's guides.
std::pmr::vector<Float4> places(const Groom& guides, const FollowMap& map, const Layout& layout,
                                std::pmr::memory_resource* memory) {
    const auto& at = map.bound.empty() ? guides.strands.positions : map.bound;
    const Middles of_guides = middles_of(at, guides.strands.vertex_counts, memory);
    const Middles of_follows = middles_of(map.strands.positions, map.strands.vertex_counts, memory);
    std::pmr::vector<Float4> rows(size_t{layout.follows} * layout.row, Float4{}, memory);
    for (size_t follow = 0; follow < map.count(); ++follow) {
        const auto middles = of_follows.of(follow);
        for (size_t k = 0; k < FollowMap::per_strand; ++k) {
            const auto guide = of_guides.of(map.guides[FollowMap::per_strand * follow + k]);
            for (size_t i = 0; i < middles.size(); ++i)
                rows[follow * layout.row + i + 1][k] = place_in(guide, middles[i]);
        }
    }
    return rows;
}

// The root, then what leads from each vertex to the next; nothing past the tip.
std::pmr::vector<Float4> segments(const FollowMap& map, const Layout& layout, uint32_t pinned,
                                  std::pmr::memory_resource* memory) {
    std::pmr::vector<Float4> rows(memory);
    rows.reserve(size_t{layout.follows} * layout.row);
    const float* p = map.strands.positions.data();
    for (const uint32_t count : map.strands.vertex_counts) {
        for (uint32_t i = 0; i < layout.row; ++i) {
            Float4 row{0, 0, 0, i < pinned ? 0.0f : 1.0f};
            for (size_t axis = 0; axis < 3 && i < count; ++axis)
                row[axis] = p[size_t{3} * i + axis] - (i > 0 ? p[3 * (i - size_t{1}) + axis] : 0);
            rows.push_back(row);
        }
        p += size_t{3} * count;
    }
    return rows;
}

// Rows of all strands, [strand][V], in the lane layout and in the lanes' order.
std::pmr::vector<float> in_lanes(const LaneLayout& lanes, std::span<const uint32_t> order,
                                 std::span<const Float4> rows, std::pmr::memory_resource* memory) {
    std::pmr::vector<float> to(4 * lanes.rows(), 0.0f, memory);
    for_each_lane_element(lanes, 4, [&](size_t index, size_t plain) {
        const size_t lane = plain / 4 / lanes.row, vertex = plain / 4 % lanes.row;
        to[index] = rows[order[lane] * lanes.row + vertex][plain % 4];
    });
    return to;
}

// So many of each strand, in the lanes' order.
template <typename T>
std::pmr::vector<T> in_order(std::span<const uint32_t> order, size_t per_strand,
                             const std::pmr::vector<T>& of, std::pmr::memory_resource* memory) {
    std::pmr::vector<T> to(memory);
    to.reserve(of.size());
    for (const uint32_t follow : order)
        to.insert(to.end(), &of[per_strand * follow], &of[per_strand * follow] + per_strand);
    return to;
}

} // namespace

Result<FollowTurns> FollowTurns::create(Device& device, const Groom& guides, const FollowMap& map,
                                        const Layout& layout, const Rules& rules,
                                        std::pmr::memory_resource* memory) {
    FollowTurns turns;
    turns.tile_ = rules.tile;
    std::pmr::vector<uint32_t> ends(memory); // of follows
    for (const uint32_t end : rules.ends)
        if (end > layout.guides)
            ends.push_back(end - layout.guides);
    constexpr auto f4 = PLAIT_ELEMENT_FLOAT4, f1 = PLAIT_ELEMENT_FLOAT, word = PLAIT_ELEMENT_UINT;
    const auto make = [&](Buffer& to, plait_element element, const auto& content,
                          const char* name) -> Status {
        const size_t bytes = content.size() * sizeof content[0];
        PLAIT_TRY(device.create(to, element, bytes / (element == f4 ? 16 : 4), name));
        return device.write(to, content.data());
    };
    constexpr size_t most = FollowMap::per_strand;
    const auto order =
        order_by_root(map.strands.positions, map.strands.vertex_counts, ends, memory);
    const auto rows = [&](const std::pmr::vector<Float4>& of) {
        return in_lanes(turns.lanes(layout), order, of, memory);
    };
    PLAIT_TRY(device.create(turns.turn_, f4, layout.guide_vertices(), "guide_turn"));
    if (!map.bound.empty())
        PLAIT_TRY(make(
            turns.bound_, f4,
            pad_rows(map.bound, guides.strands.vertex_counts, layout.row, rules.pinned, memory),
            "guides_bound"));
    PLAIT_TRY(make(turns.order_, word, order, "lane_strand"));
    PLAIT_TRY(
        make(turns.guides_, word, in_order(order, most, map.guides, memory), "follow_guides"));
    PLAIT_TRY(make(turns.weight_, f4, in_order(order, most, map.weights, memory), "follow_weight"));
    PLAIT_TRY(make(turns.place_, f1, rows(places(guides, map, layout, memory)), "follow_place"));
    PLAIT_TRY(
        make(turns.rest_, f1, rows(segments(map, layout, rules.pinned, memory)), "follow_rest"));
    return turns;
}

Status FollowTurns::read_rest(Device& device, const Layout& layout, std::span<float> rest,
                              std::pmr::memory_resource* memory) const {
    const LaneLayout of = lanes(layout);
    std::pmr::vector<float> segments(4 * of.rows(), memory);
    std::pmr::vector<uint32_t> order(layout.follows, memory);
    PLAIT_TRY(device.read(rest_, segments.data()));
    PLAIT_TRY(device.read(order_, order.data()));
    for_each_lane_element(of, 4, [&](size_t index, size_t plain) {
        const size_t row = size_t{4} * of.row;
        rest[order[plain / row] * row + plain % row] = segments[index];
    });
    return {};
}

void FollowTurns::append(Schedule& schedule, const Layout& layout, const State& state,
                         const Buffer& pose, const Buffer& guides, const Buffer& position) const {
    if (layout.follows == 0)
        return;
    schedule.add(PLAIT_STAGE_guide_turns, layout.guides, plait_layout_params{layout.row},
                 {bound_ ? &bound_ : &state.rest, &pose, &state.vertex_count, &guides, &turn_});
    schedule.add(PLAIT_STAGE_follow_turns, layout.follows,
                 plait_follow_turns_params{layout.row, tile_, layout.guides},
                 {&order_, &pose, &turn_, &guides_, &weight_, &place_, &rest_, &position},
                 layout.row);
}

uint64_t FollowTurns::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer : {&turn_, &bound_, &order_, &guides_, &weight_, &place_, &rest_})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
