// Strands that change their settings: a part of the new ones takes them over from the parts they are
// in, on the device and bit by bit. BDF2's step before stays where it is as long ago as the new
// substeps are; else it follows from x and v.
#include "core/strands/lane_part.hpp"

namespace plait {
namespace {

// Drivers compile for good when a kernel is first enqueued: here, and not in the queue that the
// next step waits for.
Status run_now(Device& device, Schedule& schedule) {
    Status status = check_supported(device, schedule.list());
    if (status)
        status = device.prepare(schedule.list());
    if (status)
        return schedule.submit(device);
    schedule.clear();
    return status;
}

} // namespace

// Material and rest shape of a strand do not depend on which others are there; a sag-free part's
// are found anew, with the report on all of them.
bool LanePart::keeps_fill() const {
    return fill_.load.mode == PLAIT_SAG_FREE_OFF;
}

// The lanes here whose strand has a place, place(strand, lane&), to come from.
template <typename Place>
Result<LanePart::Moves> LanePart::list_moves(Device& device, const Place& place) const {
    std::pmr::vector<uint32_t> list(source_.memory);
    for (uint32_t lane = 0, from = 0; lane < lanes_.padded_strands(); ++lane)
        if (place(member(lane), from))
            list.insert(list.end(), {from, lane});
    if (list.empty())
        return Moves{};
    Moves moves{{}, static_cast<uint32_t>(list.size() / 2)};
    PLAIT_TRY(device.create(moves.list, PLAIT_ELEMENT_UINT, list.size(), "lane_slot"));
    PLAIT_TRY(device.write(moves.list, list.data()));
    return moves;
}

void LanePart::move(Schedule& schedule, const Moves& moves, uint32_t components, const Buffer& from,
                    const Buffer& to) const {
    schedule.add(PLAIT_STAGE_lane_move, moves.count,
                 plait_lane_move_params{lanes_.row, lanes_.tile, components},
                 {&moves.list, &from, &to});
}

// Where other parts' rows of material and rest shape are not to be had.
Status LanePart::fill_anew(Device& device) {
    if (keeps_fill())
        return {};
    const Materials of = fill_.of;
    return make_fill(device, fill_, members_, of, fill_.load, bool(fill_.groom));
}

// After the rest rotations are there.
Status LanePart::move_from(Device& device, Schedule& schedule, const StepInput& at,
                           const LanePart& other, std::span<const LanePlace> from) {
    const auto moves = list_moves(device, [&](uint32_t strand, uint32_t& lane) {
        lane = from[strand].lane;
        return from[strand].part == &other;
    });
    if (!moves)
        return moves.error();
    if (moves->count == 0)
        return {};
    if (keeps_fill()) {
        move(schedule, *moves, PLAIT_LANE_MATERIAL_COMPONENTS, other.fill_.material,
             fill_.material);
        move(schedule, *moves, 4, other.fill_.rest, fill_.rest);
        if (fill_.start)
            move(schedule, *moves, 4, other.fill_.start, fill_.start);
        if (fill_.groom)
            move(schedule, *moves, PLAIT_LANE_GROOM_COMPONENTS, other.fill_.groom, fill_.groom);
    }
    move(schedule, *moves, 3, other.x_, x_);
    move(schedule, *moves, 3, other.v_, v_);
    move(schedule, *moves, 4, other.q_, q_);
    move(schedule, *moves, 4, other.q_before_, q_before_);
    move(schedule, *moves, 1, other.normal_force_, normal_force_);
    if (volume_.pressure && other.volume_.pressure)
        move(schedule, *moves, 3, other.volume_.pressure, volume_.pressure);
    if (takes_history_of(other)) {
        move(schedule, *moves, 3, other.history_.x, history_.x);
        move(schedule, *moves, 3, other.history_.v, history_.v);
    }
    fit(schedule, at, *moves, other);
    return run_now(device, schedule);
}

bool LanePart::takes_history_of(const LanePart& other) const {
    return history_.x && other.history_.x && other.settings_.substeps == settings_.substeps;
}

// BDF2 has a step before also of strands that come without one.
void LanePart::fit(Schedule& schedule, const StepInput& at, const Moves& moves,
                   const LanePart& other) const {
    if (!history_.x || takes_history_of(other))
        return;
    const auto h = static_cast<float>(at.step / settings_.substeps);
    schedule.add(PLAIT_STAGE_lane_fit, moves.count,
                 plait_lane_fit_params{lanes_.row, lanes_.tile, h},
                 {&moves.list, &v_, &x_, &history_.x, &history_.v});
}

Status LanePart::take_over(Device& device, Schedule& schedule, const StepInput& at,
                           std::span<const LanePlace> from) {
    fill_.of = materials();
    fill_.load = load();
    if (at.params.groom > 0 || fill_.of.holds())
        PLAIT_TRY(make(device, fill_.groom, PLAIT_LANE_GROOM_COMPONENTS, "lane_groom"));
    PLAIT_TRY(open(device));
    PLAIT_TRY(make(device, fill_.material, PLAIT_LANE_MATERIAL_COMPONENTS, "lane_material"));
    if (source_.needs.wet && !fill_.wet)
        PLAIT_TRY(make_wet(device, fill_));
    PLAIT_TRY(make(device, fill_.rest, 4, "lane_rest"));
    if (fill_.load.mode != PLAIT_SAG_FREE_OFF || fill_.of.curls())
        PLAIT_TRY(make(device, fill_.start, 4, "lane_start"));
    if (settings_.bdf2_of(at.params)) {
        PLAIT_TRY(make(device, history_.x, 3, "lane_x_before"));
        PLAIT_TRY(make(device, history_.v, 3, "lane_v_before"));
    }
    PLAIT_TRY(make_pressed(device, volume_, source_.rest_grid_of(at.params)));
    PLAIT_TRY(fill_anew(device));
    std::pmr::vector<const LanePart*> others(source_.memory);
    for (const uint32_t strand : members_)
        if (std::find(others.begin(), others.end(), from[strand].part) == others.end())
            others.push_back(from[strand].part);
    for (const LanePart* other : others)
        PLAIT_TRY(move_from(device, schedule, at, *other, from));
    return {};
}

} // namespace plait
