// What each feature appends at the moments of a call.
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
// Where the caller adds up the sums of several parts of a groom a fixed step ends twice: with the grid's
// sums, and, when they are reduced, with brakes and what comes after them.
//
// A phase appends dispatches and changes nothing else, so that the same list says which kernels a
// sim needs before its first step.
#include "core/pins/lane_springs.hpp"
#include "core/pins/pins.hpp"
#include "core/push/lane_push.hpp"
#include "core/sim/sim.hpp"

#include <algorithm>
#include <utility>

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

// Where no strand is stepped roots, bodies and pins move on, and what is shown.
void Sim::append_phases(const At& at) {
    for (const Phase phase : phases) {
        const bool goes_on = phase == &Sim::append_roots || phase == &Sim::append_meshes ||
                             phase == &Sim::append_pins || phase == &Sim::append_wetness ||
                             phase == &Sim::append_display;
        if (goes_on || !is_rigid())
            (this->*phase)(at);
    }
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
        append_pin_targets(schedule_, layout_, state_, at.end, scale_);
    if (at.moment == Moment::call_ends)
        append_pins_arrived(schedule_, layout_, state_, scale_);
}

// What it is at the end of a fixed step is what all of it is taken with.
void Sim::append_wetness(const At& at) {
    if (at.moment != Moment::step_begins || !state_.wetness)
        return;
    wetness_.append(schedule_, layout_, state_);
    for (size_t i = 0; i < model_->parts(); ++i)
        Wetness::append_material(schedule_, model_->part(i, at.substep), state_);
}

void Sim::dry() {
    if (!state_.wetness)
        return;
    wetness_.pass(clock_.step(), double(params_.wetness.drying_time));
    if (wetness_.is_dry())
        close_wetness();
}

void Sim::append_air(const At& at) {
    if (at.moment != Moment::step_begins || !wind_.blows())
        return;
    wind_.append(schedule_, {hair_is_over_lanes() ? model_.get() : nullptr, at.substep}, air(),
                 head_velocity(), clock_.step());
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
        std::ranges::copy(params_.acceleration.values, params.value);
        schedule_.add(
            PLAIT_STAGE_accelerate, stepped().guide_vertices(), params,
            {&state_.vertex_count, &state_.position, &state_.position_prev, &state_.acceleration});
    }
    if (!wind_.blows())
        for (size_t i = 0; i < model_->parts(); ++i)
            plait::append_accelerations(schedule_, model_->part(i, at.substep));
}

// Positions are those of the last step's end, and lie as far from those before as its strands moved
// in one of the sim's own substeps.
void Sim::append_pairs(const At& at) {
    if (at.moment == Moment::step_begins && pairs_.buffers())
        pairs_.append(schedule_, {stepped(), state_, params_, desc_.substeps, context_.info});
}

// The features that reach the solve by its doors, in this order: springs are known to what pushes along
// them, and both to what looks for bodies in the way.
Doors Sim::fill_doors(const StepInput& at, const Part& part) {
    Doors doors;
    fill_springs(schedule_, part, state_, at.params.groom, doors);
    if (wind_.blows())
        wind_.fill(schedule_, part, at.air, at.first, at.step, doors);
    meshes_.fill(schedule_, part, at.bodies.fields, doors);
    bending_.fill(schedule_, part, at.bodies.nearest, doors);
    pairs_.fill(schedule_, part, state_, at.params.strand_contact.friction, doors);
    return doors;
}

// Where strands meet, each sees the others where all are at the substep's begin.
void Sim::append_solve(const At& at) {
    if (at.moment != Moment::substep)
        return;
    if (pairs_.buffers())
        model_->publish(schedule_, at.substep);
    model_->substep(schedule_, at.substep,
                    [&](const Part& part) { return fill_doors(at.substep, part); });
}

StrandGrid::Step Sim::grid_step(const plait_pose& head) const {
    return {stepped(),        state_,       params_,    cube_,        head,
            substep_length(), clock_.steps, desc_.seed, context_.info};
}

// Where lanes fill a CPU's registers; elsewhere the grids see the positions that were published.
bool Sim::hair_is_over_lanes() const {
    return model_->parts() > 0 && context_.info.lanes > 1 &&
           context_.device.supports(PLAIT_STAGE_lane_splat);
}

// Not where the caller has kernels of his own for it.
bool Sim::grid_is_over_lanes() const {
    const auto& replaced = context_.replaced;
    return grid_.is_exact() && !volume_ && hair_is_over_lanes() &&
           !replaced[PLAIT_STAGE_grid_splat] && !replaced[PLAIT_STAGE_grid_diffuse] &&
           context_.device.supports(PLAIT_STAGE_lane_diffuse);
}

void Sim::append_grid_over_lanes(const At& at) {
    const bool ends = at.moment == Moment::step_ends, reduced = at.moment == Moment::sums_reduced;
    if ((!ends && !reduced) || !grid_is_over_lanes())
        return;
    const StrandGrid::Step step = grid_step(roots_.step_head());
    if (reduced)
        grid_.append_brake_over_lanes(schedule_, step, *model_, at.substep);
    else if (reduce_)
        grid_.append_sums_over_lanes(schedule_, step, *model_, at.substep);
    else
        grid_.append_over_lanes(schedule_, step, *model_, at.substep);
}

VolumeGrid Sim::volume_grid(const plait_pose& head) const {
    return {grid_params(grid_step(head)),
            static_cast<float>(clock_.step()),
            grid_.sums(),
            grid_.outside(),
            grid_.density(),
            grid_.velocity(),
            state_.wetness ? &state_.wetness : nullptr};
}

// In place of the brake. The pressure goes on from step to step; where it cannot, it is sought first.
void Sim::append_volume(const At& at) {
    if (!volume_)
        return;
    if (at.moment == Moment::step_begins && !volume_.carries)
        volume_.append_start(schedule_, volume_grid(roots_.step_begin()), *model_, first_group());
    if (at.moment == Moment::step_ends)
        volume_.append_step(schedule_, volume_grid(roots_.step_head()), *model_, first_group());
}

// What is shown of guides is what the last step of a call leaves, unless output is interpolated.
bool Sim::model_shows_guides() const {
    return model_->parts() > 0 && !display_.interpolates() &&
           !context_.replaced[PLAIT_STAGE_tangents];
}

void Sim::append_publish(const At& at) {
    const bool waits = reduce_ && grid_is_over_lanes(); // whose brake comes before it
    if (at.moment != (waits ? Moment::sums_reduced : Moment::step_ends))
        return;
    const bool shows = at.step + 1 == at.steps && model_shows_guides();
    model_->publish(schedule_, at.substep, shows ? &display_.tangent() : nullptr);
}

void Sim::append_grid(const At& at) {
    const bool ends = at.moment == Moment::step_ends, reduced = at.moment == Moment::sums_reduced;
    if ((!ends && !reduced) || !grid_.is_on() || volume_ || grid_is_over_lanes())
        return;
    const StrandGrid::Step step = grid_step(roots_.step_head());
    if (ends && reduce_)
        return grid_.append_sums(schedule_, step);
    if (reduced)
        grid_.append_brake(schedule_, step);
    else
        grid_.append(schedule_, step);
    model_->adopt(schedule_, at.substep, Changed::by_grid);
}

// A call without a fixed step leaves what is shown as it is, unless that is between two steps.
void Sim::append_display(const At& at) {
    if (at.moment == Moment::call_begins)
        display_.append_frame_before(schedule_, layout_,
                                     levels_ ? levels_->placed : layout_.strands(), state_);
    if (at.moment == Moment::step_begins && at.step + 1 == at.steps)
        display_.append_step_before(schedule_, stepped(), state_);
    if (at.moment == Moment::call_ends && (at.steps > 0 || display_.interpolates()))
        append_shown(model_shows_guides() && !(levels_ && levels_->alters_guides())
                         ? Tangents::of_follows
                         : Tangents::of_all);
}

void Sim::append_shown(Tangents tangents) {
    if (levels_) {
        levels_->ahead = display_.interpolates() ? clock_.remainder() * clock_.step() : 0;
        levels_->placed = display_.rows_of(layout_, levels_.get()).layout.strands();
    }
    display_.append(schedule_, at_shown(), roots_, static_cast<float>(clock_.remainder()), tangents,
                    levels_.get());
}

} // namespace plait
