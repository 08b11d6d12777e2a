#include "core/sim/sim.hpp"

#include <array>
#include <utility>

namespace plait {

Sim::Sim(Context& context, SimParts parts)
    : context_(context), layout_(parts.layout), desc_(parts.desc), params_(parts.params),
      materials_(std::move(parts.materials)), size_warning_(std::move(parts.size_warning)),
      hair_(parts.hair), said_{default_params(), default_material()},
      groom_warning_(std::move(parts.groom_warning)), groom_(parts.fingerprint), cube_(parts.cube),
      longest_segment_(parts.longest_segment), lengths_(parts.lengths),
      skin_(std::move(parts.skin)), model_(std::move(parts.model)), state_(std::move(parts.state)),
      reduce_(&context.memory), display_(std::move(parts.display)),
      levels_(std::move(parts.levels)), roots_(layout_, &context.memory),
      colliders_(desc_.substeps, &context.memory), meshes_(&context.memory),
      bending_(&context.memory), substeps_(1, desc_.substeps, &context.memory),
      clock_(desc_.step, desc_.max_steps_per_call), schedule_(&context.memory),
      pin_table_(&context.memory), pose_before_(&context.memory) {}

Sim::~Sim() {
    leave();
    if (context_.measured == this)
        context_.measured = nullptr;
    if (read_fence_ != 0) // the caller's memory may go with the sim
        (void)fence_reached(read_fence_, true);
}

Status Sim::start() {
    PLAIT_TRY(make_poses(pose_spare_, "pose_spare"));
    PLAIT_TRY(make_poses(pose_was_, "pose_was"));
    PLAIT_TRY(make_poses(pose_next_, "pose_next"));
    PLAIT_TRY(make_poses_before(pose_before_, substeps_.size()));
    PLAIT_TRY(check_stages());
    PLAIT_TRY(prepare_calls());
    model_->reset(schedule_, present());
    append_no_motion();
    display_.append_step_before(schedule_, stepped(), state_);
    PLAIT_TRY(show_at_once());
    PLAIT_TRY(wait());
    log_warning("");
    return {};
}

Status Sim::check_stages() {
    schedule_.clear();
    append_dry_step_of_finest();
    return check_schedule();
}

// That what was appended can run; it is not run.
Status Sim::check_schedule() {
    Status status = check_supported(device(), schedule_.list());
    if (status)
        status = device().prepare(schedule_.list());
    schedule_.clear();
    return status;
}

// What steps do not take, but the calls around them.
Status Sim::prepare_calls() {
    model_->reset(schedule_, present());
    display_.append_step_before(schedule_, stepped(), state_);
    display_.append_frame_before(schedule_, layout_, layout_.strands(), state_);
    append_shown();
    if (desc_.interpolate_output == 2)
        display_.append_interpolation(schedule_, layout_, state_);
    model_->teleport(schedule_, present(), state_.pose);
    model_->adopt(schedule_, present(), Changed::places);
    model_->set_off(schedule_, present(), pose_before_.front(), pose_was_, pose_next_, 0);
    skin_.append(schedule_, layout_, state_, state_.pose);
    binding_.append(schedule_, layout_, state_, state_.pose);
    append_level_stages();
    add_stats();
    add_bounds();
    std::pmr::vector<plait_dispatch> list(&context_.memory);
    for (const plait_dispatch& dispatch : schedule_.list())
        if (device().supports(dispatch.stage)) // else the call that wants it says so
            list.push_back(dispatch);
    Status status = device().prepare(list);
    schedule_.clear();
    return status;
}

// All work passes here, so that device time is counted for the sim that caused it.
Status Sim::submit() {
    if (context_.profile) {
        PLAIT_TRY(begin_measuring());
        schedule_.reckon_traffic(layout_.row);
    }
    for (const plait_dispatch& dispatch : schedule_.list())
        ++costs_[dispatch.stage].calls;
    return schedule_.submit(device());
}

// What jumped has moved on no way: the frame before is where it is now.
Status Sim::show_at_once() {
    PLAIT_TRY(place_colliders());
    append_shown();
    PLAIT_TRY(submit());
    display_.append_frame_before(schedule_, layout_, layout_.strands(), state_);
    return submit();
}

Status Sim::reset() {
    stir();
    schedule_.clear();
    clock_.reset();
    wind_.reset();
    volume_.carries = false;
    const bool stands = roots_.stands();
    roots_.stop(schedule_);
    roots_.forget();
    motion_.reset(stands, roots_.step_head());
    frame_.stop();
    colliders_.stop();
    bending_.stop(schedule_);
    PLAIT_TRY(bending_.forget_sides(device()));
    PLAIT_TRY(place_colliders());
    append_stopped_pins(schedule_, layout_, state_, scale_);
    roots_.append_poses_now(schedule_, state_.pose);
    append_no_motion();
    if (levels_)
        append_level_reset();
    else
        model_->reset(schedule_, present());
    display_.append_step_before(schedule_, stepped(), state_);
    return show_at_once();
}

} // namespace plait
