#include "core/follow_turns.hpp"

#include "core/follow_places.hpp"

#include <vector>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

// Of the segment before each vertex, in each of the strand's guides.
std::pmr::vector<Float4> places(const Groom& guides, const FollowMap& map, const Layout& layout,
                                std::pmr::memory_resource* memory) {
    const Middles of_guides = middles_of(guides.strands, memory);
    const Middles of_follows = middles_of(map.strands, memory);
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

} // namespace

Result<FollowTurns> FollowTurns::create(Device& device, const Groom& guides, const FollowMap& map,
                                        const Layout& layout, uint32_t pinned,
                                        std::pmr::memory_resource* memory) {
    FollowTurns turns;
    const auto make = [&](Buffer& to, plait_element element, size_t count, const char* name,
                          const void* content) -> Status {
        PLAIT_TRY(device.create(to, element, count, name));
        return device.write(to, content);
    };
    constexpr auto f4 = PLAIT_ELEMENT_FLOAT4;
    const size_t follows = map.count();
    const auto place = places(guides, map, layout, memory);
    const auto rest = segments(map, layout, pinned, memory);
    PLAIT_TRY(device.create(turns.turn_, f4, layout.guide_vertices(), "guide_turn"));
    PLAIT_TRY(make(turns.guides_, PLAIT_ELEMENT_UINT, map.guides.size(), "follow_guides",
                   map.guides.data()));
    PLAIT_TRY(make(turns.weight_, f4, follows, "follow_weight", map.weights.data()));
    PLAIT_TRY(make(turns.place_, f4, place.size(), "follow_place", place.data()));
    PLAIT_TRY(make(turns.rest_, f4, rest.size(), "follow_rest", rest.data()));
    return turns;
}

void FollowTurns::append(Schedule& schedule, const Layout& layout, const State& state,
                         const Buffer& pose, const Buffer& position) const {
    schedule.add(PLAIT_STAGE_guide_turns, layout.guides, plait_layout_params{layout.row},
                 {&state.rest, &pose, &state.vertex_count, &position, &turn_});
    schedule.add(PLAIT_STAGE_follow_turns, layout.follows,
                 plait_follow_turns_params{layout.row, layout.guides},
                 {&pose, &turn_, &guides_, &weight_, &place_, &rest_, &position});
}

uint64_t FollowTurns::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer : {&turn_, &guides_, &weight_, &place_, &rest_})
        bytes += buffer->bytes();
    return bytes;
}

} // namespace plait
