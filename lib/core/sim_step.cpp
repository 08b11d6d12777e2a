// A call of plait_sim_step: its moments, and at each of them the phases that have something to do.
//
//                     call begins      fixed step begins     substep     fixed step ends   call ends
//   roots                              poses of their own    poses
//   meshes that bend                   vertices, boxes
//   pins                               targets                                             targets
//   wetness                            dries; material
//   air                                eddies, shelter
//   volume                             pressure at rest                  pressure, velocities
//   accelerations                      of single vertices
//   pairs of strands                     which may meet
//   solve                                                    the model
//   grid over lanes                                                      brakes velocities
//   publish                                                              positions,
//                                                                        tangents
//   grid                                                                 brakes velocities
//   display           frame before     step before                                         follows,
//                                                                                          tangents
//
// A phase appends dispatches and changes nothing else, so that the same list says which kernels a
// sim needs before its first step. What the host keeps (paths of roots, pins and colliders, the
// wind's grid and time, how much of the wetness is left) moves on by advance() and place(), once a
// fixed step, and by arrive(), at the end of a call.
#include "core/pins.hpp"
#include "core/sim.hpp"

#include <algorithm>

namespace plait {

// In the order in which they act at one moment.
constexpr Sim::Phase Sim::phases[] = {
    &Sim::append_roots,           &Sim::append_meshes,  &Sim::append_pins,
    &Sim::append_wetness,         &Sim::append_air,
    &Sim::append_volume, // whose pressure is an acceleration
    &Sim::append_accelerations,   &Sim::append_pairs,   &Sim::append_solve,
    &Sim::append_grid_over_lanes, &Sim::append_publish, &Sim::append_grid,
    &Sim::append_display,
};

void Sim::append_phases(const At& at) {
    for (const Phase phase : phases)
        (this->*phase)(at);
}

Status Sim::step(double dt) {
    schedule_.clear(); // what a failed call may have left
    const Tick tick = clock_.advance(dt);
    if (tick.steps > 0)
        log_off();
    else
        PLAIT_TRY(place_colliders());
    append_phases({Moment::call_begins, present(), 0, tick.steps});
    for (uint32_t k = 0; k < tick.steps; ++k)
        PLAIT_TRY(fixed_step(tick.end_of(k), k, tick.steps));
    roots_.arrive();
    colliders_.arrive();
    bending_.arrive();
    append_phases({Moment::call_ends, present(), tick.steps, tick.steps});
    return submit();
}

Status Sim::fixed_step(double end, uint32_t step, uint32_t steps) {
    roots_.advance(end);
    advance_pins(state_);
    dry();
    wind_.place(cube_, roots_.step_begin());
    PLAIT_TRY(colliders_.advance(device(), end));
    bending_.advance(end);
    append_phases({Moment::step_begins, present(), step, steps, static_cast<float>(end)});
    const auto substeps = [&](const Group& group) -> Status {
        for (uint32_t i = 0; i < group.substeps; ++i) {
            append_phases({Moment::substep, at(group, i), step, steps});
            PLAIT_TRY(submit());
        }
        return {};
    };
    PLAIT_TRY(for_each_group(substeps));
    append_phases({Moment::step_ends, present(), step, steps});
    PLAIT_TRY(submit());
    if (grid_.volume())
        grid_.volume().carry();
    if (wind_.blows())
        wind_.advance(clock_.step());
    ++clock_.steps;
    return {};
}

// Of a fixed step in which nothing moves: its first substep stands for all of a group's.
void Sim::append_dry_step() {
    append_phases({Moment::step_begins, present()});
    (void)for_each_group([&](const Group& group) {
        append_phases({Moment::substep, at(group, 0)});
        return Status{};
    });
    append_phases({Moment::step_ends, present()});
    append_shown();
}

void Sim::append_roots(const At& at) {
    if (at.moment == Moment::step_begins)
        roots_.append_path(schedule_);
    if (at.moment == Moment::substep)
        roots_.append_poses(schedule_, at.substep.share, state_.pose);
}

// A dry step, which is of none, has all that any may take.
void Sim::append_meshes(const At& at) {
    if (at.moment == Moment::step_begins)
        bending_.append(schedule_, at.steps == 0);
}

void Sim::append_pins(const At& at) {
    if (at.moment == Moment::step_begins)
        append_pin_targets(schedule_, layout_, state_, at.end);
    if (at.moment == Moment::call_ends)
        append_pins_arrived(schedule_, layout_, state_);
}

// What it is at the end of a fixed step is what all of it is taken with.
void Sim::append_wetness(const At& at) {
    if (at.moment != Moment::step_begins || !state_.wetness)
        return;
    wetness_.append(schedule_, layout_, state_);
    model_->soak(schedule_, at.substep);
}

void Sim::dry() {
    if (!state_.wetness)
        return;
    wetness_.pass(clock_.step(), double(desc_.params.drying_time));
    if (wetness_.is_dry())
        close_wetness();
}

void Sim::append_air(const At& at) {
    if (at.moment != Moment::step_begins || !wind_.blows())
        return;
    const InterHair::Step step = grid_step(roots_.step_begin());
    wind_.append(schedule_, {step, hair_is_over_lanes() ? model_.get() : nullptr, at.substep},
                 air(), head_velocity(), clock_.step());
}

// What pulls at single vertices in all substeps of a fixed step, where they are at its begin.
void Sim::append_accelerations(const At& at) {
    if (at.moment != Moment::step_begins || !state_.acceleration)
        return;
    if (context_.replaced[PLAIT_STAGE_accelerate]) {
        plait_accelerate_params params{};
        params.vertex_stride = layout_.row;
        params.h = substep_length();
        params.time = static_cast<float>(clock_.time());
        std::ranges::copy(desc_.params.accelerate_values, params.value);
        schedule_.add(
            PLAIT_STAGE_accelerate, layout_.guide_vertices(), params,
            {&state_.vertex_count, &state_.position, &state_.position_prev, &state_.acceleration});
    }
    model_->accelerate(schedule_, at.substep);
}

// Positions are those of the last step's end, and lie as far from those before as its strands moved
// in one of the sim's own substeps.
void Sim::append_pairs(const At& at) {
    if (at.moment == Moment::step_begins && pairs_.buffers())
        pairs_.append(schedule_, {layout_, state_, desc_.params, desc_.substeps, context_.info});
}

void Sim::append_solve(const At& at) {
    if (at.moment == Moment::substep)
        model_->substep(schedule_, at.substep);
}

InterHair::Step Sim::grid_step(const plait_pose& head) const {
    return {layout_,          state_,       desc_.params, cube_,        head,
            substep_length(), clock_.steps, desc_.seed,   context_.info};
}

// Where lanes fill a CPU's registers; elsewhere the grids see the positions that were published.
bool Sim::hair_is_over_lanes() const {
    return model_->has_lanes() && context_.info.lanes > 1 &&
           context_.device.supports(PLAIT_STAGE_lane_splat);
}

// Not where the caller has kernels of his own for it.
bool Sim::grid_is_over_lanes() const {
    const auto& replaced = context_.replaced;
    return grid_.is_exact() && !grid_.volume() && hair_is_over_lanes() &&
           !replaced[PLAIT_STAGE_grid_splat] && !replaced[PLAIT_STAGE_grid_diffuse] &&
           context_.device.supports(PLAIT_STAGE_lane_diffuse);
}

void Sim::append_grid_over_lanes(const At& at) {
    if (at.moment == Moment::step_ends && grid_is_over_lanes())
        grid_.append_over_lanes(schedule_, grid_step(roots_.step_head()), *model_, at.substep);
}

// In place of the brake. The pressure goes on from step to step; where it cannot, it is sought first.
void Sim::append_volume(const At& at) {
    if (!grid_.volume())
        return;
    if (at.moment == Moment::step_begins && !grid_.volume().carries)
        grid_.append_volume_start(schedule_, grid_step(roots_.step_begin()), *model_,
                                  first_group());
    if (at.moment == Moment::step_ends)
        grid_.append_volume(schedule_, grid_step(roots_.step_head()), *model_, first_group());
}

// What is shown of guides is what the last step of a call leaves, unless output is interpolated.
bool Sim::model_shows_guides() const {
    return model_->has_lanes() && !display_.interpolates() &&
           !context_.replaced[PLAIT_STAGE_tangents];
}

void Sim::append_publish(const At& at) {
    if (at.moment != Moment::step_ends)
        return;
    const bool shows = at.step + 1 == at.steps && model_shows_guides();
    model_->publish(schedule_, at.substep, shows ? &display_.tangent() : nullptr);
}

void Sim::append_grid(const At& at) {
    if (at.moment != Moment::step_ends || !grid_.is_on() || grid_.volume() || grid_is_over_lanes())
        return;
    grid_.append(schedule_, grid_step(roots_.step_head()));
    model_->adopt(schedule_, at.substep);
}

// A call without a fixed step leaves what is shown as it is, unless that is between two steps.
void Sim::append_display(const At& at) {
    if (at.moment == Moment::call_begins)
        display_.append_frame_before(schedule_, layout_, state_);
    if (at.moment == Moment::step_begins && at.step + 1 == at.steps)
        display_.append_step_before(schedule_, layout_, state_);
    if (at.moment == Moment::call_ends && (at.steps > 0 || display_.interpolates()))
        append_shown(model_shows_guides() ? Tangents::of_follows : Tangents::of_all);
}

void Sim::append_shown(Tangents tangents) {
    display_.append(schedule_, first_group(), roots_, static_cast<float>(clock_.remainder()),
                    tangents);
}

Substep Sim::at(const Group& group, uint32_t substep) const {
    return {layout_,
            state_,
            desc_.params,
            colliders_.buffer(),
            colliders_.count() - colliders_.meshes(),
            (group.first + substep) * colliders_.count(),
            meshes_.buffers() ? colliders_.meshes() - colliders_.bending() : 0,
            meshes_.buffers(),
            bending_.buffers() ? colliders_.bending() : 0,
            bending_.buffers(),
            pairs_.buffers(),
            clock_.step(),
            group.substeps,
            length_of(group.substeps),
            air(),
            static_cast<float>(substep + 1) / static_cast<float>(group.substeps),
            wind_.blows() ? std::optional(wind_.at(air(), substep == 0, clock_.step()))
                          : std::nullopt};
}

std::array<float, 3> Sim::air() const {
    const plait_sim_params& p = desc_.params;
    std::array<float, 3> air{p.wind[0], p.wind[1], p.wind[2]};
    if (p.air_with_head == 0)
        return air;
    const auto head = head_velocity();
    for (size_t i = 0; i < 3; ++i)
        air[i] += p.air_with_head * head[i];
    return air;
}

std::array<float, 3> Sim::head_velocity() const {
    float middle[3];
    for (size_t i = 0; i < 3; ++i)
        middle[i] = cube_.origin[i] + 0.5f * cube_.edge;
    auto velocity = roots_.head_moves(middle);
    for (float& v : velocity)
        v /= static_cast<float>(clock_.step());
    return velocity;
}

} // namespace plait
