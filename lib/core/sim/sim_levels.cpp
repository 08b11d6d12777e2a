// A sim whose level changes. A step is made and shown by the level that ends with it; then strands that
// are stepped from now on begin where they were shown, and what the next level would show otherwise is
// kept, and fades.
#include "core/sim/sim.hpp"

#include <algorithm>
#include <utility>

namespace plait {
namespace {

Error has_none() {
    return {PLAIT_INVALID_STATE,
            "the sim has no levels: it was created without plait_sim_desc.levels"};
}

} // namespace

Status Sim::set_level(const plait_level_choice& choice) {
    return levels_ ? levels_->choose(choice) : has_none();
}

Result<plait_level_state> Sim::level_state() const {
    if (!levels_)
        return has_none();
    return plait_level_state{sizeof(plait_level_state), levels_->level(),
                             levels_->shown(),          static_cast<float>(levels_->blending()),
                             levels_->swing.rms(),      is_asleep()};
}

// Eddies, drying, moving frames and kernels of the caller's go on whatever the host is told; and sums of
// several parts are added up in every step of each.
bool Sim::is_asleep() const {
    return levels_ && levels_->may_sleep() && !wind_.blows() && !state_.wetness &&
           !frame_.is_on() && !reduce_ && *no_accelerate() != '\0';
}

void Sim::stir() {
    if (levels_)
        levels_->swing.stillness.stir();
    told_ = 0;
}

void Sim::set_rest(float speed) {
    if (levels_)
        levels_->swing.stillness.set_speed(speed);
}

// Time passes. What is shown is from the first such call on what it was in the frame before.
Status Sim::doze(double dt) {
    clock_.steps += clock_.advance(dt).steps;
    if (std::exchange(dozes_, true))
        return {};
    append_phases({Moment::call_begins, present()});
    return submit();
}

bool Sim::describe_levels(DirectedHair& out) const {
    if (!levels_)
        return false;
    levels_->describe(double(scale_), out);
    out.substeps = substeps();
    out.meets_bodies = colliders().count() > 0;
    return true;
}

// Between two steps of the last call of a level strands that it does not step have a place, too, which
// interpolated output needs of those that it wakes: out of the bodies, which are there until the step moves
// them on, as where they begin.
Status Sim::keep_level_before() {
    if (!levels_ || !levels_->wakes())
        return {};
    levels_->append_before(schedule_, state_);
    if (!display_.interpolates())
        return {};
    PLAIT_TRY(place_colliders());
    LevelRows rows = levels_->rows(display_.turns(), levels_->next_stepped());
    rows.share = 0;
    display_.append_step(schedule_, first_group(), *levels_, rows);
    schedule_.add(PLAIT_STAGE_output_keep, levels_->next_stepped() * layout_.row,
                  plait_layout_params{layout_.row},
                  {&state_.pose, &display_.before_scale(state_), &display_.kept()});
    return submit();
}

// Fixed steps are over, and the head and bodies are where the call sent them.
Status Sim::pass_levels(double s) {
    levels_->pass(s);
    levels_->swing.pass(s);
    if (levels_->is_rigid())
        levels_->swing.stillness.stand(s);
    if (levels_->changes_level())
        return switch_level();
    if (levels_->is_due())
        levels_->take();
    return {};
}

// What this call brings into view has not been placed in the frame before, which it is to have come from:
// kept as that frame is where it would have been. To be asked before anything moves on.
Status Sim::append_coming(double dt) {
    if (!levels_ || !display_.last_frame() || !levels_->is_due() ||
        levels_->next_in_view() <= levels_->placed)
        return {};
    Clock clock = clock_;
    if (clock.advance(dt).steps == 0)
        return {};
    PLAIT_TRY(place_colliders());
    display_.append_coming(schedule_, at_shown(), roots_, static_cast<float>(clock_.remainder()),
                           levels_->rows(display_.turns(), levels_->next_in_view()), *levels_);
    return {};
}

// Where strands are woken a blend that has not ended is not, but in what is shown it is.
Status Sim::switch_level() {
    const Buffer& shown = display_.before_scale(state_);
    const StepInput at = at_shown();
    const auto remainder = static_cast<float>(clock_.remainder());
    const bool wakes = levels_->wakes(), freezes = levels_->next_stepped() == 0;
    const bool thaws = levels_->is_rigid();
    levels_->ahead = display_.interpolates() ? clock_.remainder() * clock_.step() : 0;
    // Strands are woken and kept that may not be shown.
    const uint32_t all = layout_.strands();
    LevelRows rows = levels_->rows(
        display_.turns(),
        freezes || wakes ? all : std::max(levels_->in_view(), levels_->next_in_view()));
    if (wakes) {
        LevelRows plain = rows;
        plain.share = 0;
        display_.append_step(schedule_, first_group(), *levels_, plain);
        levels_->append_after(schedule_, state_);
        model_->wake(schedule_, present(), levels_->waking(shown));
    }
    display_.append_rows(schedule_, at, roots_, remainder, rows, levels_.get(), shown);
    if (freezes)
        display_.append_detail(schedule_, at, rows);
    display_.append_out(schedule_, at, rows, shown);
    if (freezes)
        levels_->append_freeze(schedule_, display_.pose(state_), shown);
    else
        levels_->append_shown(schedule_, shown);
    levels_->take();
    model_->step_first(levels_->stepped());
    if (wakes) {
        model_->publish(schedule_, present());
        volume_.carries = false; // theirs is of when they were stepped last
    }
    if (freezes || levels_->blending() == 0)
        return {};
    rows = levels_->rows(display_.turns(), thaws ? all : levels_->shown());
    rows.share = 0;
    display_.append_rows(schedule_, at, roots_, remainder, rows, levels_.get(), shown);
    if (thaws) { // what was kept has its detail, and lies on bodies
        display_.append_detail(schedule_, at, rows);
        display_.append_out(schedule_, at, rows, shown);
    }
    levels_->append_lacking(schedule_, display_.pose(state_), shown);
    return {};
}

// Appends as if all strands were stepped: of any level there are no other stages, but its own.
void Sim::append_dry_step_of_finest() {
    if (!levels_) {
        append_dry_step();
        return;
    }
    const uint32_t level = levels_->exchange_level(levels_->top());
    model_->step_first(layout_.guides);
    append_dry_step();
    (void)levels_->exchange_level(level);
    model_->step_first(levels_->stepped());
}

// Strands that go with their roots do not swing: what they did last is the best guess.
Status Sim::submit_with_probes() {
    if (!levels_ || levels_->is_rigid())
        return submit();
    PLAIT_TRY(levels_->swing.take(device(), scale_));
    const bool due = levels_->swing.is_due();
    if (due)
        levels_->append_probes(schedule_, state_, display_.before_scale(state_));
    PLAIT_TRY(submit());
    probed_ = probed_ || due;
    return {};
}

// Not where steps of several sims overlap: there a read is in no order with them.
Status Sim::ask_for_probes() {
    if (!std::exchange(probed_, false))
        return {};
    const auto fence = levels_->swing.ask(device(), state_.position);
    if (fence)
        read_fence_ = *fence;
    return fence ? Status{} : fence.error();
}

// All that a switch may take, for when kernels are built.
void Sim::append_level_stages() {
    if (!levels_)
        return;
    const Buffer& shown = display_.before_scale(state_);
    model_->wake(schedule_, present(),
                 {0, layout_.guides, pose_was_, levels_->before(), levels_->before(), shown});
    levels_->append_freeze(schedule_, state_.pose, shown);
    levels_->append_shown(schedule_, shown);
    schedule_.add(PLAIT_STAGE_level_show, layout_.vertices(), plait_level_params{layout_.row, 1, 1},
                  {&levels_->roots(), &state_.pose, &levels_->held(), &shown});
}

// Where no strand is stepped all of them are put at rest once, and kept.
void Sim::append_level_reset() {
    levels_->end_blend();
    if (!levels_->is_rigid()) {
        model_->reset(schedule_, present());
        return;
    }
    model_->step_first(layout_.guides);
    model_->reset(schedule_, present());
    display_.append_step(schedule_, first_group(), *levels_, levels_->finest(display_.turns()));
    levels_->append_freeze(schedule_, state_.pose, display_.before_scale(state_));
    model_->step_first(0);
}

} // namespace plait
