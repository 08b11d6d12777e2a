#include "core/levels/sim_levels.hpp"

#include "base/format.hpp"
#include "core/base/ranges.hpp"

#include <algorithm>

namespace plait {

plait_level_choice default_level_choice() {
    return {sizeof(plait_level_choice), 0, 0, 0.3f, 0};
}

// Follows of the finest level go with the root of the guide that each follows most.
Status SimLevels::open(Device& device, const FollowMap& map, std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> roots(memory);
    for (uint32_t guide = 0; guide < all_.guides; ++guide)
        roots.push_back(guide);
    for (size_t i = 0; i < map.guides.size(); i += FollowMap::per_strand)
        roots.push_back(map.guides[i]);
    constexpr auto f4 = PLAIT_ELEMENT_FLOAT4;
    PLAIT_TRY(device.create(root_guide_, PLAIT_ELEMENT_UINT, roots.size(), "root_guide"));
    PLAIT_TRY(device.write(root_guide_, roots.data()));
    PLAIT_TRY(device.create(held_, f4, all_.vertices(), "held"));
    const std::pmr::vector<float> none(4 * all_.vertices(), 0.0f,
                                       memory); // snapshots have all of it
    PLAIT_TRY(device.write(held_, none.data()));
    PLAIT_TRY(device.create(from_, f4, all_.guide_vertices(), "wake_from"));
    PLAIT_TRY(device.create(to_, f4, all_.guide_vertices(), "wake_to"));
    return device.create(pose_before_, f4, size_t{2} * all_.guides, "pose_before");
}

// Vertices of strands in the levels' order.
static std::pmr::vector<uint32_t> counts_of(const Levels& levels,
                                            std::pmr::memory_resource* memory) {
    std::pmr::vector<uint32_t> counts(memory);
    for (const uint32_t strand : levels.order())
        counts.push_back(levels.groom().strands.vertex_counts[strand]);
    return counts;
}

Result<std::unique_ptr<SimLevels>> SimLevels::create(Device& device, const Levels& levels,
                                                     uint32_t top, const FollowMap& map,
                                                     const Layout& layout,
                                                     const FollowTurns::Rules& rules,
                                                     std::pmr::memory_resource* memory) {
    auto made = std::make_unique<SimLevels>(memory);
    made->guides_.assign(levels.guides().begin(), levels.guides().end());
    made->ends_ = levels.ends();
    for (size_t level = 0; level < levels.guides().size(); ++level)
        made->shares_[level] = levels.share(level);
    made->length_ = levels.groom().shape.mean_length;
    made->all_ = layout;
    made->top_ = made->level_ = top;
    made->shown_ = made->placed = layout.strands();
    made->next_ = {sizeof(plait_level_choice), top, layout.strands(), 0, 0};
    made->turns_.resize(levels.guides().size());
    for (uint32_t level = top + 1; level < levels.guides().size() && levels.guides()[level] > 0;
         ++level) {
        Groom guides{StrandSet(memory), {}, {}};
        FollowMap follows(memory);
        PLAIT_TRY(levels.take(level, guides, follows));
        const uint32_t count = levels.guides()[level];
        auto turns = FollowTurns::create(
            device, guides, follows, {count, layout.strands() - count, layout.row}, rules, memory);
        if (!turns)
            return turns.error();
        made->turns_[level] = std::move(*turns);
    }
    PLAIT_TRY(made->open(device, map, memory));
    PLAIT_TRY(made->swing.open(device, counts_of(levels, memory), layout.row));
    return made;
}

uint32_t SimLevels::shown_of(uint32_t asked) const {
    return asked == 0 ? all_.strands() : *std::ranges::lower_bound(ends_, asked);
}

void SimLevels::describe(double scale, DirectedHair& out) const {
    // Hair that is still now may swing in the next frame: by a fortieth of its length, as in a walk; and
    // what nobody has seen yet, by twice that.
    constexpr double least = 1.0 / 40, unknown = 1.0 / 20;
    const double rms = double(swing.rms()), length = scale * length_;
    out.swing = rms < 0 ? unknown * length : std::max(rms, least * length);
    std::ranges::copy(guides_, out.guides.begin());
    out.share = shares_;
    out.first_level = top_;
    out.level_count = static_cast<uint32_t>(guides_.size());
    // Fewer than an eighth no longer cover a head.
    for (const uint32_t end : ends_)
        if (end >= all_.strands() / 8)
            out.shown[out.shown_count++] = end;
    out.vertices = all_.row;
    out.now = due_ ? LevelChoice{next_.level, next_.shown} : LevelChoice{level_, shown_};
}

Status SimLevels::check_choice(const plait_level_choice& choice) const {
    if (choice.level < top_ || choice.level >= guides_.size())
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("choice->level is %u, range is [%u, %zu], from the sim's level_top on",
                            choice.level, top_, guides_.size() - 1)};
    if (choice.shown > all_.strands())
        return Error{
            PLAIT_INVALID_ARGUMENT,
            format("choice->shown is %u, range is [0, %u], strands", choice.shown, all_.strands())};
    PLAIT_TRY(check_range("choice->blend", double(choice.blend), 0, 5));
    return check_range("choice->rest", double(choice.rest), 0, 1);
}

Status SimLevels::choose(const plait_level_choice& choice) {
    PLAIT_TRY(check_choice(choice));
    next_ = choice;
    next_.shown = shown_of(choice.shown);
    due_ = next_.level != level_ || next_.shown != shown_;
    swing.stillness.set_speed(choice.rest);
    if (due_)
        swing.stillness.stir();
    return {};
}

// What comes into view goes over to the level, too, from where it would have been: it has a way that it has
// come since the frame before.
void SimLevels::take() {
    shown_ = next_.shown;
    if (changes_level()) {
        blended_ = next_in_view();
        level_ = next_.level;
        blend_ = is_rigid() ? 0 : next_.blend;
        since_ = -ahead;
    }
    due_ = false;
}

void SimLevels::pass(double s) {
    since_ += s;
}

LevelRows SimLevels::rows(const FollowTurns& top, uint32_t strands) const {
    LevelRows rows{{stepped(), strands > stepped() ? strands - stepped() : 0, all_.row}};
    if (!is_rigid() && rows.layout.follows > 0)
        rows.turns = level_ == top_ ? &top : &turns_[level_];
    const double time = since_ + ahead;
    if (time < double(blend_)) {
        const double s = time / double(blend_);
        rows.share = static_cast<float>(1 - s * s * (3 - 2 * s));
        rows.blended = std::min(blended_, rows.layout.strands());
    }
    return rows;
}

void SimLevels::append_level(Schedule& schedule, plait_stage stage, uint32_t strands, bool whole,
                             float share, const Buffer& pose, const Buffer& position) const {
    const plait_level_params params{all_.row, whole ? 1u : 0u, share};
    if (stage == PLAIT_STAGE_level_keep)
        schedule.add(stage, strands * all_.row, params, {&root_guide_, &pose, &position, &held_});
    else
        schedule.add(stage, strands * all_.row, params, {&root_guide_, &pose, &held_, &position});
}

void SimLevels::append(Schedule& schedule, const LevelRows& rows, const State& state,
                       const Buffer& pose, const Buffer& guides, const Buffer& position) const {
    if (rows.layout.guides == 0)
        append_level(schedule, PLAIT_STAGE_level_show, rows.layout.strands(), true, 1, pose,
                     position);
    if (rows.turns)
        rows.turns->append(schedule, rows.layout, state, pose, guides, position);
    if (rows.share > 0)
        append_level(schedule, PLAIT_STAGE_level_show, rows.blended, false, rows.share, pose,
                     position);
}

// Their rows lie first among those of follows.
void SimLevels::append_places(Schedule& schedule, const State& state, const Buffer& to) const {
    if (is_rigid())
        append_level(schedule, PLAIT_STAGE_level_show, next_stepped(), true, 1, state.pose, to);
    else
        turns_[level_].append(schedule, {stepped(), next_stepped() - stepped(), all_.row}, state,
                              state.pose, state.position, to);
}

void SimLevels::append_before(Schedule& schedule, const State& state) const {
    schedule.add(PLAIT_STAGE_last_frame, 2 * all_.guides, plait_last_frame_params{2, 1},
                 {&state.pose, &pose_before_});
    append_places(schedule, state, from_);
}

void SimLevels::append_after(Schedule& schedule, const State& state) const {
    append_places(schedule, state, to_);
}

void SimLevels::append_freeze(Schedule& schedule, const Buffer& pose,
                              const Buffer& position) const {
    append_level(schedule, PLAIT_STAGE_level_keep, all_.strands(), true, 1, pose, position);
}

void SimLevels::append_shown(Schedule& schedule, const Buffer& position) const {
    schedule.add(PLAIT_STAGE_last_frame, next_in_view() * all_.row,
                 plait_last_frame_params{all_.row, 1}, {&position, &held_});
}

void SimLevels::append_lacking(Schedule& schedule, const Buffer& pose,
                               const Buffer& position) const {
    append_level(schedule, PLAIT_STAGE_level_keep, blended_, false, 1, pose, position);
}

void SimLevels::append_probes(Schedule& schedule, const State& state,
                              const Buffer& position) const {
    schedule.add(PLAIT_STAGE_level_keep, swing.strands() * all_.row,
                 plait_level_params{all_.row, 1, 1},
                 {&root_guide_, &state.pose, &position, &swing.probes()});
}

SimLevels::Kept SimLevels::kept() const {
    Kept kept{level_, shown_, blended_, blend_, since_, due_, 0, 0, 0};
    if (due_) {
        kept.next_level = next_.level;
        kept.next_shown = next_.shown;
        kept.next_blend = next_.blend;
    }
    return kept;
}

Status SimLevels::check(const Kept& kept) const {
    for (const uint32_t level : {kept.level, kept.due ? kept.next_level : kept.level})
        if (level < top_ || level >= guides_.size())
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("the snapshot is of level %u, the sim has levels %u to %zu", level,
                                top_, guides_.size() - 1)};
    for (const uint32_t shown : {kept.shown, kept.due ? kept.next_shown : kept.shown})
        if (!std::ranges::binary_search(ends_, shown) || kept.blended > all_.strands())
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("the snapshot shows %u strands, the sim's levels show up to %u",
                                shown, all_.strands())};
    return {};
}

void SimLevels::restore(const Kept& kept) {
    level_ = kept.level;
    shown_ = kept.shown;
    blended_ = kept.blended;
    blend_ = kept.blend;
    since_ = kept.since;
    due_ = kept.due != 0;
    next_.level = due_ ? kept.next_level : level_;
    next_.shown = due_ ? kept.next_shown : shown_;
    next_.blend = kept.next_blend;
}

uint64_t SimLevels::device_bytes() const {
    uint64_t bytes = root_guide_.bytes() + held_.bytes() + from_.bytes() + to_.bytes() +
                     pose_before_.bytes() + swing.device_bytes();
    for (const FollowTurns& turns : turns_)
        bytes += turns.device_bytes();
    return bytes;
}

} // namespace plait
