// Strands that change their settings: a part of the new ones takes them over from the parts they
// are in, on the device and bit by bit. x and v stay as they are, and so does q between the rods; a
// strand that was a chain has had none, and gets those of least turn in every joint. What stretched
// and becomes an articulated strand is taken to its lengths. BDF2's step before stays where it is as
// long ago as the new substeps are; else it follows from x and v.
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
bool LanePart::keeps_fill_of(const LanePart& other) const {
    return other.settings_.model == settings_.model && fill_.load.mode == PLAIT_SAG_FREE_OFF;
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

// Material and rest shape of the strands whose rows no part has.
Status LanePart::fill_arrivals(Device& device, Schedule& schedule,
                               std::span<const LanePlace> from) {
    Members arrivals(source_.memory);
    for (const uint32_t strand : members_)
        if (!keeps_fill_of(*from[strand].part))
            arrivals.push_back(strand);
    if (arrivals.empty())
        return {};
    Fill fill(source_.memory);
    PLAIT_TRY(make_fill(device, fill, arrivals, fill_.of, fill_.load, bool(fill_.groom)));
    uint32_t next = 0; // arrivals keep the order of the lanes
    const auto moves = list_moves(device, [&](uint32_t strand, uint32_t& lane) {
        next += next + 1 < arrivals.size() && arrivals[next + 1] == strand;
        lane = next;
        return arrivals[next] == strand;
    });
    if (!moves)
        return moves.error();
    fill_.sag = fill.sag;
    move(schedule, *moves, PLAIT_LANE_MATERIAL_COMPONENTS, fill.material, fill_.material);
    move(schedule, *moves, 4, fill.rest, fill_.rest);
    if (fill.start)
        move(schedule, *moves, 4, fill.start, fill_.start);
    if (fill.groom)
        move(schedule, *moves, PLAIT_LANE_GROOM_COMPONENTS, fill.groom, fill_.groom);
    return run_now(device, schedule);
}

// After the rest rotations are there.
Status LanePart::move_from(Device& device, Schedule& schedule, const Substep& at,
                           const LanePart& other, std::span<const LanePlace> from) {
    const auto moves = list_moves(device, [&](uint32_t strand, uint32_t& lane) {
        lane = from[strand].lane;
        return from[strand].part == &other;
    });
    if (!moves)
        return moves.error();
    if (moves->count == 0)
        return {};
    if (keeps_fill_of(other)) {
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
    if (volume_.pressure && other.volume_.pressure)
        move(schedule, *moves, 3, other.volume_.pressure, volume_.pressure);
    if (takes_history_of(other)) {
        move(schedule, *moves, 3, other.history_.x, history_.x);
        move(schedule, *moves, 3, other.history_.v, history_.v);
    }
    if (!other.traits_.bends && traits_.bends) {
        schedule.add(
            PLAIT_STAGE_lane_orient, moves->count, layout_params(at),
            {&moves->list, &lane_strand_, &at.state.pose, &fill_.rest, &x_, &v_, &q_, &q_before_});
    }
    fit(schedule, at, *moves, other);
    return run_now(device, schedule);
}

bool LanePart::takes_history_of(const LanePart& other) const {
    return history_.x && other.history_.x && other.settings_.substeps == settings_.substeps;
}

// The first solve of what cannot stretch takes its velocities from strands that have not; BDF2 has
// a step before also of those that came without.
void LanePart::fit(Schedule& schedule, const Substep& at, const Moves& moves,
                   const LanePart& other) const {
    const bool stretched = other.traits_.stretches && !traits_.stretches && traits_.bends;
    const bool anew = history_.x && (stretched || !takes_history_of(other));
    if (!stretched && !anew)
        return;
    const auto h = static_cast<float>(at.step / settings_.substeps);
    schedule.add(
        PLAIT_STAGE_lane_fit, moves.count,
        plait_lane_fit_params{lanes_.row, lanes_.tile, h, anew ? 1u : 0u, stretched ? 1u : 0u},
        {&moves.list, &fill_.material, &v_, &x_, anew ? &history_.x : nullptr,
         anew ? &history_.v : nullptr});
}

Status LanePart::take_over(Device& device, Schedule& schedule, const Substep& at,
                           std::span<const LanePlace> from) {
    fill_.of = materials_of(at.params);
    fill_.load = load();
    if (at.params.groom > 0 || fill_.of.holds())
        PLAIT_TRY(make(device, fill_.groom, PLAIT_LANE_GROOM_COMPONENTS, "lane_groom"));
    PLAIT_TRY(open(device));
    PLAIT_TRY(make(device, fill_.material, PLAIT_LANE_MATERIAL_COMPONENTS, "lane_material"));
    if (source_.wet)
        PLAIT_TRY(make_wet(device, fill_));
    PLAIT_TRY(make(device, fill_.rest, 4, "lane_rest"));
    if (fill_.load.mode != PLAIT_SAG_FREE_OFF || fill_.of.curls())
        PLAIT_TRY(make(device, fill_.start, 4, "lane_start"));
    if (settings_.bdf2_of(at.params)) {
        PLAIT_TRY(make(device, history_.x, 3, "lane_x_before"));
        PLAIT_TRY(make(device, history_.v, 3, "lane_v_before"));
    }
    PLAIT_TRY(make_pressed(device, volume_, source_.rest_grid_of(at.params)));
    PLAIT_TRY(fill_arrivals(device, schedule, from));
    std::pmr::vector<const LanePart*> others(source_.memory);
    for (const uint32_t strand : members_)
        if (std::find(others.begin(), others.end(), from[strand].part) == others.end())
            others.push_back(from[strand].part);
    for (const LanePart* other : others)
        PLAIT_TRY(move_from(device, schedule, at, *other, from));
    return {};
}

} // namespace plait
