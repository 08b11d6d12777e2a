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
#include "base/format.hpp"
#include "core/pins/lane_springs.hpp"
#include "core/pins/pins.hpp"
#include "core/push/lane_push.hpp"
#include "core/sim/sim.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plait {
namespace {

// m/s: a head that is placed and then moves on otherwise than before by less has set off by itself;
// none does so by more in a step, and hair goes along with it.
constexpr float least_jump = 0.9f;

} // namespace

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

// A head that moves in no time has been put elsewhere.
Status Sim::step(double dt) {
    schedule_.clear(); // what a failed call may have left
    if (ends_between_steps(dt))
        PLAIT_TRY(display_.interpolate(device(), schedule_, layout_, state_));
    warn_of_jump(dt);
    const Tick tick = clock_.advance(dt);
    begun_ = begun_ || dt > 0;
    if (tick.steps > 0)
        log_ignored();
    append_phases({Moment::call_begins, present(), 0, tick.steps});
    const bool jumps = dt == 0 && roots_.moves();
    if (jumps)
        PLAIT_TRY(place());
    else if (tick.steps == 0)
        PLAIT_TRY(place_colliders());
    if (tick.dropped > 0)
        PLAIT_TRY(skip(tick.end_of_dropped()));
    for (uint32_t k = 0; k < tick.steps; ++k)
        PLAIT_TRY(fixed_step(tick.end_of(k), k, tick.steps));
    roots_.arrive();
    frame_.arrive();
    colliders_.arrive();
    bending_.arrive();
    append_phases({Moment::call_ends, present(), tick.steps, tick.steps});
    if ((jumps || (dt == 0 && resized_)) && !display_.interpolates())
        append_shown();
    resized_ = resized_ && dt > 0 && tick.steps == 0;
    return submit();
}

// A head speeds up by some m/s in a frame when it is hit. Said once.
void Sim::warn_of_jump(double dt) {
    constexpr double fastest = 20; // m/s
    if (!context_.log.callback || said_jump_ || dt == 0 || !told_)
        return;
    const auto middle = cube_.middle();
    const auto way = roots_.call_moves(middle.data());
    double square = 0, far = 0;
    for (size_t i = 0; i < 3; ++i) {
        const double velocity = double(scale_) * double(way[i]) / dt;
        square += (velocity - call_velocity_[i]) * (velocity - call_velocity_[i]);
        far += std::pow(double(scale_) * double(way[i]), 2);
        call_velocity_[i] = velocity;
    }
    said_jump_ = std::sqrt(square) > fastest && knows_velocity_;
    knows_velocity_ = true;
    if (said_jump_)
        context_.log(
            PLAIT_LOG_LEVEL_WARNING,
            format("sim: the head moves by %.3g m in a call of %.3g s, %.3g m/s faster than "
                   "before, and hair is dragged along: if it has been put elsewhere, "
                   "plait_sim_teleport takes hair along",
                   std::sqrt(far), dt, std::sqrt(square)));
}

// Whether it is the first call to do so that is to show hair between them.
bool Sim::ends_between_steps(double dt) const {
    if (desc_.interpolate_output != 2 || display_.interpolates())
        return false;
    Clock clock = clock_;
    clock.advance(dt);
    constexpr double least = 1e-3; // of a step: less is what sums of frames round to
    const double after = clock.remainder();
    return after > least && after < 1 - least;
}

// Time that is dropped takes hair along with the head, and bodies where they are by then.
Status Sim::skip(double end) {
    append_last_motion();
    roots_.jump(schedule_, end);
    frame_.jump(end);
    colliders_.jump(end);
    for (int k = 0; k < 2; ++k) { // the path's begin is the end of the one before
        bending_.advance(end);
        bending_.append(schedule_, false);
        advance_pins(state_);
        append_pin_targets(schedule_, layout_, state_, static_cast<float>(end), scale_);
    }
    roots_.append_poses(schedule_, 1, pose_spare_);
    append_placed();
    told_ = true;
    return submit();
}

Status Sim::fixed_step(double end, uint32_t step, uint32_t steps) {
    append_carried(end);
    if (std::exchange(first_aim_, false) && !told_)
        colliders_.place(); // with the head
    roots_.advance(end);
    append_set_off();
    advance_pins(state_);
    dry();
    wind_.place(cube_, roots_.step_begin());
    PLAIT_TRY(colliders_.advance(device(), end, roots_.bends()));
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
    if (volume_)
        volume_.carry();
    if (wind_.blows())
        wind_.advance(clock_.step());
    ++clock_.steps;
    return {};
}

// What hair does not feel of its frame's motion takes all along that hair knows of: its state, and the
// paths on which it was moved and touched so far. The rest of the step is then as it is felt.
void Sim::append_carried(double end) {
    frame_.advance(end);
    const plait_pose motion = frame_.unfelt();
    if (same_pose(motion, identity_pose))
        return;
    roots_.carry(motion);
    colliders_.carry(motion);
    model_->carry(schedule_, present(), motion);
    roots_.append_poses(schedule_, 1, state_.pose);
}

// The first step whose way is known since the head was placed says how it moves. A step without an aim
// says nothing: the call that placed the head may have stood for the aim. Hair waits through it.
void Sim::append_set_off() {
    if (motion_ == Motion::known)
        return;
    if (motion_ == Motion::framed) {
        append_reframed();
        return;
    }
    roots_.straighten();
    const bool waits = !told_ && !waited_;
    const bool as_before = motion_ == Motion::as_before && waited_ && goes_on_as_before();
    const float jump = motion_ == Motion::as_before && !waits && !waited_ ? least_jump : 0.0f;
    waited_ = waits;
    motion_ = waits ? motion_ : Motion::known;
    if (roots_.rest())
        return;
    roots_.append_path(schedule_);
    size_t before = 0;
    (void)for_each_group([&](const Group& group) {
        const float part = 1.0f / static_cast<float>(group.substeps);
        if (as_before)
            roots_.append_poses_of(schedule_, next_as_before(part), pose_next_);
        else
            roots_.append_poses(schedule_, part, pose_next_);
        model_->set_off(schedule_, at(group, 0), pose_before_[before++], pose_was_, pose_next_,
                        jump);
        return Status{};
    });
    if (waits) // hair has none of the head's motion now
        append_no_motion();
}

// Where the head would be after `part` of this step had it moved on as it did when it was placed.
plait_pose Sim::next_as_before(double part) const {
    const plait_pose& now = roots_.step_begin();
    return interpolate(now, carried(now, placed_from_, placed_to_), part);
}

// As far as the host can tell: roots with poses of their own may do as they like.
bool Sim::goes_on_as_before() const {
    if (roots_.have_own())
        return false;
    const auto middle = cube_.middle();
    const plait_pose next = next_as_before(1);
    float expected[3], found[3], turned[4];
    transform(next, middle.data(), expected);
    transform(roots_.step_head(), middle.data(), found);
    turn(next, roots_.step_head(), turned);
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
        const double arc = 2 * PLAIT_SET_OFF_REACH * double(turned[i]);
        square += (double(found[i]) - expected[i]) * (double(found[i]) - expected[i]) + arc * arc;
    }
    return std::sqrt(square) < double(least_jump) * clock_.step();
}

// Hair has had the head's motion of the step before less what was not felt then, and gets it less what
// is not felt now.
void Sim::append_reframed() {
    const plait_pose& now = roots_.step_begin();
    roots_.append_poses_of(schedule_, now, pose_was_);
    size_t before = 0;
    (void)for_each_group([&](const Group& group) {
        const plait_pose was = roots_.before(1 - 1.0 / group.substeps);
        const plait_pose is = carried(was, frame_.unfelt_before(), frame_.unfelt());
        const Buffer& pose_before = pose_before_[before++];
        roots_.append_poses_of(schedule_, was, pose_before);
        roots_.append_poses_of(schedule_, carried(now, is, now), pose_next_);
        model_->set_off(schedule_, at(group, 0), pose_before, pose_was_, pose_next_, 0);
        return Status{};
    });
    motion_ = Motion::known;
}

// Of a fixed step in which nothing moves: its first substep stands for all of a group's.
void Sim::append_dry_step() {
    if (frame_.is_on())
        model_->carry(schedule_, present(), identity_pose);
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
            PLAIT_STAGE_accelerate, layout_.guide_vertices(), params,
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
        pairs_.append(schedule_, {layout_, state_, params_, desc_.substeps, context_.info});
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
    return {layout_,          state_,       params_,    cube_,        head,
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
    if (at.moment == Moment::step_ends && grid_is_over_lanes())
        grid_.append_over_lanes(schedule_, grid_step(roots_.step_head()), *model_, at.substep);
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
    if (at.moment != Moment::step_ends)
        return;
    const bool shows = at.step + 1 == at.steps && model_shows_guides();
    model_->publish(schedule_, at.substep, shows ? &display_.tangent() : nullptr);
}

void Sim::append_grid(const At& at) {
    if (at.moment != Moment::step_ends || !grid_.is_on() || volume_ || grid_is_over_lanes())
        return;
    grid_.append(schedule_, grid_step(roots_.step_head()));
    model_->adopt(schedule_, at.substep, Changed::by_grid);
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

Bodies Sim::bodies(uint32_t substep) const {
    const Buffer& rows = colliders_.buffer();
    const uint32_t first = substep * colliders_.count();
    const uint32_t solids = colliders_.count() - colliders_.meshes();
    const uint32_t nearest = bending_.buffers() ? colliders_.bending() : 0;
    const uint32_t fields = meshes_.buffers() ? colliders_.meshes() - colliders_.bending() : 0;
    return {{rows, first, solids},
            {rows, first + solids, fields},
            {rows, first + solids + fields, nearest},
            meshes_.buffers(),
            bending_.buffers()};
}

StepInput Sim::at(const Group& group, uint32_t substep) const {
    return {layout_,
            state_,
            params_,
            bodies(group.first + substep),
            clock_.step(),
            group.substeps,
            length_of(group.substeps),
            air(),
            wind_.blows() ? 0 : params_.drag,
            static_cast<float>(substep + 1) / static_cast<float>(group.substeps),
            substep == 0};
}

std::array<float, 3> Sim::air() const {
    std::array<float, 3> air{};
    const float share = params_.air_with_head;
    const auto middle = cube_.middle();
    float place[3];
    transform(roots_.step_begin(), middle.data(), place);
    const auto frame = frame_.air(place, clock_.step());
    const auto head = head_velocity();
    for (size_t i = 0; i < 3; ++i)
        air[i] = frame[i] + (share != 0 ? share * head[i] : 0.0f);
    return air;
}

std::array<float, 3> Sim::head_velocity() const {
    const auto middle = cube_.middle();
    auto velocity = roots_.head_moves(middle.data());
    for (float& v : velocity)
        v /= static_cast<float>(clock_.step());
    return velocity;
}

} // namespace plait
