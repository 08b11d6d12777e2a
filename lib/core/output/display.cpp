#include "core/output/display.hpp"

#include "base/hash.hpp"
#include "core/base/choices.hpp"
#include "core/follows/out_of_bodies.hpp"
#include "core/groom/groom.hpp"

#include <Eigen/Geometry>

#include <vector>

namespace plait {
namespace {

using Float4 = std::array<float, 4>;

// U(-r, r) t0 + U(-r, r) t1, t0 and t1 normal to the guide's first segment (TressFX 3.1, there
// from the C library's generator). Depends on seed and follow only, not on the guides before.
Float4 follow_offset(const float* guide, const FollowRules& rules, uint64_t follow) {
    const Eigen::Map<const Eigen::Vector3f> root(guide), next(guide + 3);
    const Eigen::Vector3f along = (next - root).normalized();
    const Eigen::Vector3f t0 = along.unitOrthogonal();
    const Eigen::Vector3f t1 = along.cross(t0);
    const Eigen::Vector3f offset = rules.radius * (uniform_signed(rules.seed, 2 * follow) * t0 +
                                                   uniform_signed(rules.seed, 2 * follow + 1) * t1);
    return {offset[0], offset[1], offset[2], 0};
}

void append_copy(Schedule& schedule, uint32_t vertices, const plait_last_frame_params& params,
                 const Buffer& from, const Buffer& to) {
    schedule.add(PLAIT_STAGE_last_frame, vertices, params, {&from, &to});
}

} // namespace

Result<Display> Display::create(Device& device, const Groom& groom, const Layout& layout,
                                const FollowRules& follows, const DisplayRules& rules,
                                std::pmr::memory_resource* memory) {
    Display display;
    constexpr auto f4 = PLAIT_ELEMENT_FLOAT4;
    PLAIT_TRY(device.create(display.tangent_, f4, layout.vertices(), "tangent"));
    if (rules.keeps_last_frame)
        PLAIT_TRY(device.create(display.last_frame_, f4, layout.vertices(), "position_last_frame"));
    display.levels_ = rules.levels;
    if (rules.interpolates || rules.levels)
        PLAIT_TRY(device.create(display.position_out_, f4, layout.vertices(), "position_out"));
    if (rules.interpolates)
        PLAIT_TRY(display.make_between(device, layout));
    if (layout.follows > 0 && follows.map)
        PLAIT_TRY(display.make_turns(device, groom, layout, follows, memory));
    else if (layout.follows > 0)
        PLAIT_TRY(display.make_follows(device, groom, layout, follows, memory));
    return display;
}

Status Display::make_between(Device& device, const Layout& layout) {
    PLAIT_TRY(device.create(position_local_, PLAIT_ELEMENT_FLOAT4, layout.guide_vertices(),
                            "position_local"));
    return device.create(pose_now_, PLAIT_ELEMENT_FLOAT4, size_t{2} * layout.guides, "pose_now");
}

Status Display::interpolate(Device& device, Schedule& schedule, const Layout& layout,
                            State& state) {
    if (position_out_) {
        PLAIT_TRY(make_between(device, layout));
        append_step_before(schedule, layout, state);
        return {};
    }
    Buffer position;
    PLAIT_TRY(device.create(position, PLAIT_ELEMENT_FLOAT4, layout.guide_vertices(), "position"));
    PLAIT_TRY(make_between(device, layout));
    position_out_ = std::move(state.position);
    state.position = std::move(position);
    append_copy(schedule, layout.guide_vertices(), {layout.row, 1}, position_out_, state.position);
    append_step_before(schedule, layout, state);
    return {};
}

Status Display::open_scale(Device& device, Schedule& schedule, const Layout& layout, State& state) {
    Buffer position;
    PLAIT_TRY(device.create(position, PLAIT_ELEMENT_FLOAT4, layout.vertices(), "position"));
    position.swap(position_out_ ? position_out_ : state.position);
    scaled_ = std::move(position);
    append_copy(schedule, layout.vertices(), {layout.row, 1}, scaled_, this->position(state));
    return {};
}

void Display::append_interpolation(Schedule& schedule, const Layout& layout,
                                   const State& state) const {
    append_copy(schedule, layout.guide_vertices(), {layout.row, 1}, state.position,
                state.position_prev);
    schedule.add(PLAIT_STAGE_output_keep, layout.guide_vertices(), plait_layout_params{layout.row},
                 {&state.pose, &state.position, &state.position_prev});
    schedule.add(PLAIT_STAGE_output, layout.guide_vertices(), plait_output_params{layout.row, 1},
                 {&state.rest, &state.position, &state.pose, &state.pose, &state.position_prev});
}

Status Display::make_follows(Device& device, const Groom& groom, const Layout& layout,
                             const FollowRules& rules, std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> guides(memory);
    std::pmr::vector<Float4> offsets(memory);
    guides.reserve(layout.follows);
    offsets.reserve(layout.follows);
    const float* strand = groom.strands.positions.data();
    for (uint32_t guide = 0; guide < layout.guides; ++guide) {
        for (uint32_t i = 0; i < rules.per_guide; ++i) {
            offsets.push_back(follow_offset(strand, rules, offsets.size()));
            guides.push_back(guide);
        }
        strand += size_t{3} * groom.strands.vertex_counts[guide];
    }
    PLAIT_TRY(device.create(follow_guide_, PLAIT_ELEMENT_UINT, guides.size(), "follow_guide"));
    PLAIT_TRY(device.create(follow_offset_, PLAIT_ELEMENT_FLOAT4, offsets.size(), "follow_offset"));
    PLAIT_TRY(device.write(follow_guide_, guides.data()));
    return device.write(follow_offset_, offsets.data());
}

// As its guide, a strand's first: that with the greatest weight.
Status Display::make_turns(Device& device, const Groom& groom, const Layout& layout,
                           const FollowRules& rules, std::pmr::memory_resource* memory) {
    auto turns = FollowTurns::create(device, groom, *rules.map, layout, rules.turns, memory);
    if (!turns)
        return turns.error();
    turns_ = std::move(*turns);
    std::pmr::vector<uint32_t> guides(memory);
    for (size_t i = 0; i < rules.map->guides.size(); i += FollowMap::per_strand)
        guides.push_back(rules.map->guides[i]);
    PLAIT_TRY(device.create(follow_guide_, PLAIT_ELEMENT_UINT, guides.size(), "follow_guide"));
    return device.write(follow_guide_, guides.data());
}

// [4*strands*V], where the groom, or the map, or the offset from the guide has them.
Result<std::pmr::vector<float>> Display::rest_of_all(Device& device, const Layout& layout,
                                                     const State& state,
                                                     std::span<const uint32_t> guides,
                                                     std::pmr::memory_resource* memory) const {
    std::pmr::vector<float> rest(size_t{4} * layout.vertices(), memory);
    PLAIT_TRY(device.read(state.rest, rest.data()));
    float* const follows = rest.data() + size_t{4} * layout.guide_vertices();
    const size_t row = size_t{4} * layout.row;
    if (turns_) {
        PLAIT_TRY(turns_.read_rest(device, layout, std::span(follows, size_t{layout.follows} * row),
                                   memory));
        for (size_t follow = 0; follow < layout.follows; ++follow)
            for (size_t i = 4; i < row; ++i)
                follows[follow * row + i] += follows[follow * row + i - 4];
        return rest;
    }
    std::pmr::vector<Float4> offsets(layout.follows, memory);
    PLAIT_TRY(device.read(follow_offset_, offsets.data()));
    for (size_t follow = 0; follow < layout.follows; ++follow)
        for (size_t i = 0; i < row; ++i)
            follows[follow * row + i] = rest[guides[follow] * row + i] + offsets[follow][i % 4];
    return rest;
}

Result<Detail> Display::make_detail(Device& device, const Layout& layout, const State& state,
                                    const plait_detail_desc& desc,
                                    std::span<const uint32_t> centres,
                                    std::pmr::memory_resource* memory) const {
    if (layout.follows == 0)
        return Error{
            PLAIT_INVALID_STATE,
            "the sim has no follow strands, which detail is of: it was created with "
            "neither follow_map nor follows_per_guide, nor with levels whose finest has fewer "
            "guides than the groom strands"};
    std::pmr::vector<uint32_t> guides(layout.follows, memory), counts(layout.strands(), memory);
    PLAIT_TRY(device.read(follow_guide_, guides.data()));
    PLAIT_TRY(device.read(state.vertex_count, counts.data()));
    const auto rest = rest_of_all(device, layout, state, guides, memory);
    if (!rest)
        return rest.error();
    return Detail::create(device, desc, centres, {layout, *rest, counts, guides}, memory);
}

// As clumps whose centres are the guides: roots stay, and from a third of the length on a strand is
// drawn by the whole share.
Status Display::keep_wetness(Device& device, const Layout& layout, const State& state, bool keep,
                             std::pmr::memory_resource* memory) {
    if (!keep)
        wet_ = {};
    if (!keep || wet_ || layout.follows == 0)
        return {};
    plait_detail_desc desc = default_detail_desc();
    std::fill_n(desc.clump + 1, 3, 1.0f);
    std::pmr::vector<uint32_t> guides(layout.follows, memory);
    PLAIT_TRY(device.read(follow_guide_, guides.data()));
    auto made = make_detail(device, layout, state, desc, guides, memory);
    if (!made)
        return made.error();
    wet_ = std::move(*made);
    return {};
}

void Display::append_step_before(Schedule& schedule, const Layout& layout,
                                 const State& state) const {
    if (interpolates())
        schedule.add(PLAIT_STAGE_output_keep, layout.guide_vertices(),
                     plait_layout_params{layout.row},
                     {&state.pose, &state.position, &position_local_});
}

void Display::append_frame_before(Schedule& schedule, const Layout& layout, uint32_t strands,
                                  const State& state) const {
    if (last_frame_)
        append_copy(schedule, strands * layout.row, {layout.row, 1}, shown(state), last_frame_);
}

void Display::append_coming(Schedule& schedule, const StepInput& at, const Roots& roots,
                            float remainder, const LevelRows& rows, const SimLevels& levels) const {
    append_rows(schedule, at, roots, remainder, rows, &levels, last_frame_);
    append_out(schedule, at, rows, last_frame_);
    if (has_scale())
        append_copy(schedule, rows.layout.vertices(), {rows.layout.row, scale}, last_frame_,
                    last_frame_);
}

void Display::append_guides(Schedule& schedule, const Layout& layout, const State& state,
                            const Buffer& to) const {
    if (&to != &state.position)
        append_copy(schedule, layout.guide_vertices(), {layout.row, 1}, state.position, to);
}

void Display::append_out(Schedule& schedule, const StepInput& at, const LevelRows& rows,
                         const Buffer& to) const {
    if (meets_colliders(at.params) && rows.turns)
        append_out_of_bodies(schedule, rows.layout, at.bodies, rows.turns->order(), to);
}

// Hair of which nothing is stepped was kept with its detail.
void Display::append_detail(Schedule& schedule, const StepInput& at, const LevelRows& rows) const {
    if (rows.layout.guides == 0)
        return;
    const Buffer& pose = this->pose(at.state);
    const Buffer& shown = position(at.state);
    if (detail_)
        detail_.append(schedule, at.layout, pose, follow_guide_, shown);
    if (wet_ && at.state.wetness) // of all that sets them apart, curl and frizz, too
        wet_.append(schedule, at.layout, pose, follow_guide_, shown, &at.state.wetness);
}

void Display::append_step(Schedule& schedule, const StepInput& at, const SimLevels& levels,
                          const LevelRows& rows) const {
    const Buffer& shown = position(at.state);
    append_guides(schedule, rows.layout, at.state, shown);
    levels.append(schedule, rows, at.state, at.state.pose, at.state.position, shown);
    append_out(schedule, at, rows, shown);
}

void Display::append_rows(Schedule& schedule, const StepInput& at, const Roots& roots,
                          float remainder, const LevelRows& rows, const SimLevels* levels,
                          const Buffer& to) const {
    const Layout& layout = rows.layout;
    const State& state = at.state;
    const Buffer& pose = this->pose(state);
    if (interpolates()) {
        roots.append_poses_now(schedule, pose_now_);
        schedule.add(PLAIT_STAGE_output, layout.guide_vertices(),
                     plait_output_params{layout.row, remainder},
                     {&position_local_, &state.position, &state.pose, &pose_now_, &to});
    } else {
        append_guides(schedule, layout, state, to);
    }
    if (levels)
        levels->append(schedule, rows, state, pose, to, to);
    else if (rows.turns)
        rows.turns->append(schedule, layout, state, pose, to, to);
    else if (layout.follows > 0)
        schedule.add(
            PLAIT_STAGE_tressfx_follow, layout.follows * layout.row,
            plait_tressfx_follow_params{layout.row, layout.guides, at.params.tip_separation,
                                        of_kernels(at.params.follow_form)},
            {&state.rest, &pose, &state.vertex_count, &follow_guide_, &follow_offset_, &to});
}

// Detail is of strands that follow at every level, and of them all: a clump's centre has to be there.
LevelRows Display::rows_of(const Layout& layout, const SimLevels* levels) const {
    return levels ? levels->rows(turns_, detail_ || wet_ ? layout.strands() : levels->shown())
                  : LevelRows{layout, turns_ ? &turns_ : nullptr};
}

void Display::append(Schedule& schedule, const StepInput& at, const Roots& roots, float remainder,
                     Tangents tangents, const SimLevels* levels) const {
    const LevelRows rows = rows_of(at.layout, levels);
    const Layout& layout = rows.layout;
    const State& state = at.state;
    const Buffer& shown = position(state); // at the groom's size until the end
    append_rows(schedule, at, roots, remainder, rows, levels, shown);
    append_detail(schedule, at, rows);
    append_out(schedule, at, rows, shown);
    const uint32_t first = tangents == Tangents::of_all ? 0 : layout.guides;
    if (first < layout.strands())
        schedule.add(PLAIT_STAGE_tangents, (layout.strands() - first) * layout.row,
                     plait_tangents_params{layout.row, first},
                     {&state.vertex_count, &shown, &tangent_});
    if (has_scale())
        append_copy(schedule, layout.vertices(), {layout.row, scale}, shown, scaled_);
}

uint64_t Display::device_bytes() const {
    uint64_t bytes = 0;
    for (const Buffer* buffer : {&tangent_, &follow_guide_, &follow_offset_, &last_frame_, &scaled_,
                                 &position_local_, &position_out_, &pose_now_})
        bytes += buffer->bytes();
    return bytes + turns_.device_bytes() + detail_.device_bytes() + wet_.device_bytes();
}

} // namespace plait
