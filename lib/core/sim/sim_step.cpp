// A call of plait_sim_step. What the host keeps (paths of roots, pins and colliders, the wind's grid and
// time, how much of the wetness is left) moves on by advance() and place(), once a fixed step, and by
// arrive(), at the end of a call. What the device does is in sim_phases.cpp.
#include "base/format.hpp"
#include "core/pins/pins.hpp"
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

// m, what hair about `middle` goes from one pose to the other, turns and all.
double way_between(const plait_pose& from, const plait_pose& to, const float middle[3]) {
    float begin[3], end[3], turned[4];
    transform(from, middle, begin);
    transform(to, middle, end);
    turn(from, to, turned);
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
        const double arc = 2 * PLAIT_SET_OFF_REACH * double(turned[i]);
        square += (double(end[i]) - begin[i]) * (double(end[i]) - begin[i]) + arc * arc;
    }
    return std::sqrt(square);
}

} // namespace

// A head that moves in no time has been put elsewhere.
Status Sim::step(double dt) {
    schedule_.clear(); // what a failed call may have left
    if (is_asleep())
        return doze(dt);
    dozes_ = false;
    PLAIT_TRY(append_coming(dt));
    if (ends_between_steps(dt))
        PLAIT_TRY(display_.interpolate(device(), schedule_, layout_, state_));
    warn_of_jump(dt);
    const Tick tick = clock_.advance(dt);
    if (dt > 0)
        motion_.begin(HeadMotion::Begun::time);
    if (tick.steps > 0)
        log_ignored();
    append_phases({Moment::call_begins, present(), 0, tick.steps});
    const bool jumps = dt == 0 && roots_.moves();
    if (jumps)
        PLAIT_TRY(place());
    if (tick.dropped > 0)
        PLAIT_TRY(skip(tick.end_of_dropped()));
    for (uint32_t k = 0; k < tick.steps; ++k)
        PLAIT_TRY(fixed_step(tick, k));
    roots_.arrive();
    frame_.arrive();
    colliders_.arrive();
    bending_.arrive();
    PLAIT_TRY(place_colliders());
    if (levels_ && tick.steps > 0)
        PLAIT_TRY(pass_levels(tick.steps * clock_.step()));
    append_phases({Moment::call_ends, present(), tick.steps, tick.steps});
    if ((jumps || (dt == 0 && resized_)) && !display_.interpolates())
        append_shown();
    resized_ = resized_ && dt > 0 && tick.steps == 0;
    return submit_with_probes();
}

// A head speeds up by some m/s in a frame when it is hit. Said once.
void Sim::warn_of_jump(double dt) {
    constexpr double fastest = 20; // m/s
    if (!context_.log.callback || said_jump_ || dt == 0 || !motion_.is_told())
        return;
    const auto middle = cube().middle();
    const auto way = roots_.call_moves(middle.data());
    std::array<double, 3> velocity{};
    double far = 0;
    for (size_t i = 0; i < 3; ++i) {
        velocity[i] = double(scale_) * double(way[i]) / dt;
        far += std::pow(double(scale_) * double(way[i]), 2);
    }
    const double faster = motion_.faster(velocity);
    said_jump_ = faster > fastest;
    if (said_jump_)
        context_.log(
            PLAIT_LOG_LEVEL_WARNING,
            format("sim: the head moves by %.3g m in a call of %.3g s, %.3g m/s faster than "
                   "before, and hair is dragged along: if it has been put elsewhere, "
                   "plait_sim_teleport takes hair along",
                   std::sqrt(far), dt, faster));
}

// Whether it is the first call to do so that is to show hair between them.
bool Sim::ends_between_steps(double dt) const {
    if (desc_.interpolate_output != 2 || display_.interpolates())
        return false;
    Clock clock = clock_;
    clock.advance(dt);
    constexpr double least = 1e-5; // of a step: less is what sums of frames round to
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
    motion_.skip();
    return submit();
}

Status Sim::fixed_step(const Tick& tick, uint32_t step) {
    const double end = tick.end_of(step);
    const uint32_t steps = tick.steps;
    append_carried(end, tick.step / tick.dt);
    if (motion_.puts_bodies())
        colliders_.place();
    roots_.advance(end);
    append_set_off();
    advance_pins(state_);
    dry();
    wind_.place(cube(), roots_.step_begin());
    if (levels_ && !levels_->is_rigid())
        wind_.crowd = static_cast<float>(layout_.guides) / static_cast<float>(levels_->stepped());
    if (step + 1 == steps)
        PLAIT_TRY(keep_level_before());
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
    if (reduce_ && grid_.is_on())
        PLAIT_TRY(reduce_sums(step, steps));
    if (volume_ && !is_rigid())
        volume_.carry();
    if (wind_.blows())
        wind_.advance(clock_.step());
    ++clock_.steps;
    return {};
}

// Whether the head, which came from `was`, came as a frame that drives takes it, to `driven`, rather than as one
// that stands leaves it.
bool Sim::drove(const plait_pose& was, const plait_pose& now, const plait_pose& driven) const {
    const auto middle = cube().middle();
    return way_between(driven, now, middle.data()) < way_between(was, now, middle.data());
}

// What hair does not feel of its frame's motion takes all along that hair knows of: its state, and the
// paths on which it was moved and touched so far. The rest of the step is then as it is felt. The step
// is `part` of the call.
void Sim::append_carried(double end, double part) {
    const plait_pose& was = roots_.step_begin();
    if (const auto way = frame_.driven(end, part))
        if (drove(was, roots_.step_head(), carried(was, way->first, way->second)))
            frame_.come_from(way->first);
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
    if (motion_.is(HeadMotion::Known::all))
        return;
    if (motion_.is(HeadMotion::Known::reframed)) {
        append_reframed();
        return;
    }
    roots_.straighten();
    const HeadMotion::SetOff how = motion_.set_off(goes_on_as_put());
    const float jump = how.by_itself ? least_jump : 0.0f;
    if (roots_.rest())
        return;
    roots_.append_path(schedule_);
    size_t before = 0;
    (void)for_each_group([&](const Group& group) {
        const float part = 1.0f / static_cast<float>(group.substeps);
        if (how.goes_on)
            roots_.append_poses_of(schedule_, motion_.next(roots_.step_begin(), part), pose_next_);
        else
            roots_.append_poses(schedule_, part, pose_next_);
        model_->set_off(schedule_, at(group, 0), pose_before_[before++], pose_was_, pose_next_,
                        jump);
        return Status{};
    });
    model_->publish(schedule_, present());
    if (how.waits) // hair has none of the head's motion now
        append_no_motion();
}

// As far as the host can tell: roots with poses of their own may do as they like.
bool Sim::goes_on_as_put() const {
    if (roots_.have_own())
        return false;
    const auto middle = cube().middle();
    return way_between(motion_.next(roots_.step_begin(), 1), roots_.step_head(), middle.data()) <
           double(least_jump) * clock_.step();
}

// The frame's motion in the step before that is not felt by the shares of now. Of a frame that is new
// nobody knows it: it drove on as now or stood, whichever is more like what the head did.
plait_pose Sim::unfelt_then() const {
    if (frame_.unfelt_then() || !frame_.is_on())
        return frame_.unfelt_then().value_or(identity_pose);
    const plait_pose was = roots_.before(0);
    const plait_pose driven = carried(was, identity_pose, frame_.motion());
    return drove(was, roots_.step_begin(), driven) ? frame_.unfelt() : identity_pose;
}

// Hair has had the head's motion of the step before less what was not felt then, and gets it less what
// is not felt from now on.
void Sim::append_reframed() {
    const plait_pose& now = roots_.step_begin();
    const plait_pose felt_from = carried(roots_.before(0), frame_.unfelt_before(), unfelt_then());
    roots_.append_poses_of(schedule_, now, pose_was_);
    size_t before = 0;
    (void)for_each_group([&](const Group& group) {
        const double share = 1 - 1.0 / group.substeps;
        const plait_pose is = interpolate(felt_from, now, share);
        const Buffer& pose_before = pose_before_[before++];
        roots_.append_poses_of(schedule_, roots_.before(share), pose_before);
        roots_.append_poses_of(schedule_, carried(now, is, now), pose_next_);
        model_->set_off(schedule_, at(group, 0), pose_before, pose_was_, pose_next_, 0);
        return Status{};
    });
    model_->publish(schedule_, present());
    roots_.come_from(felt_from);
    motion_.end_reframing();
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
    if (reduce_)
        append_phases({Moment::sums_reduced, present()});
    append_shown();
}

Bodies Sim::bodies(const Buffer& rows, uint32_t substep) const {
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
    return at(group, substep, bodies(colliders_.buffer(), group.first + substep));
}

// Between two steps bodies are, as the head is, where the last call sent them.
StepInput Sim::at_shown() const {
    if (!display_.interpolates())
        return first_group();
    const uint32_t substeps = substeps_.front();
    return at({substeps, 0}, substeps - 1, bodies(colliders_.shown(), 0));
}

StepInput Sim::at(const Group& group, uint32_t substep, const Bodies& bodies) const {
    return {layout_,
            stepped(),
            state_,
            params_,
            bodies,
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
    const auto middle = cube().middle();
    float place[3];
    transform(roots_.step_begin(), middle.data(), place);
    const auto frame = frame_.air(place, clock_.step());
    const auto head = head_velocity();
    for (size_t i = 0; i < 3; ++i)
        air[i] = frame[i] + (share != 0 ? share * head[i] : 0.0f);
    return air;
}

std::array<float, 3> Sim::head_velocity() const {
    const auto middle = cube().middle();
    auto velocity = roots_.head_moves(middle.data());
    for (float& v : velocity)
        v /= static_cast<float>(clock_.step());
    return velocity;
}

} // namespace plait
