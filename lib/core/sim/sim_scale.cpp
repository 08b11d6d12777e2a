// Hair that is larger or smaller than its groom.
#include "base/format.hpp"
#include "core/base/ranges.hpp"
#include "core/pins/pins.hpp"
#include "core/sim/sim.hpp"

#include <plait/params.h>

#include <algorithm>
#include <utility>

namespace plait {

// That of bones is on top of the caller's.
Result<float> Sim::scale_of(const RootsInput& input) {
    if (input.bones.empty())
        return input.scale;
    const auto bones = skin_.scale_of(input.bones, &context_.memory);
    if (!bones)
        return bones.error();
    const float scale = input.scale * bones->all;
    PLAIT_TRY(check_range("roots->scale times that of roots->bones", double(scale), 1e-3f, 1e3));
    if (!bones->is_even() && !std::exchange(said_uneven_, true) && context_.log.callback)
        context_.log(PLAIT_LOG_LEVEL_WARNING,
                     format("sim: bones[%zu] scales by %.3g, %.3g and %.3g along its axes, bones "
                            "together by %.3g, which hair has: it is not stretched",
                            bones->bone, bones->of_bone[0], bones->of_bone[1], bones->of_bone[2],
                            double(bones->all)));
    return scale;
}

// Makes what shows hair at a size of its own, before it is needed. What is shown stays.
Status Sim::open_scale(float scale) {
    if (scale == 1 || display_.has_scale())
        return {};
    schedule_.clear();
    schedule_.add(PLAIT_STAGE_last_frame, layout_.guide_vertices(),
                  plait_last_frame_params{layout_.row, 1},
                  {&state_.position, &state_.position_prev});
    PLAIT_TRY(check_schedule());
    PLAIT_TRY(display_.open_scale(device(), schedule_, layout_, state_));
    return submit();
}

// Seen from the head and in its size nothing moves: as the head has another place in the new units, all
// that is near it has, too. On its way it has another velocity in them, which hair has with it. What of
// the head's motion is not known is in neither.
Status Sim::rescale(float scale) {
    if (scale == scale_)
        return {};
    const double ratio = double(scale_) / double(scale);
    const bool moves = motion_.is_on_its_way() && !roots_.rest();
    schedule_.clear();
    if (moves)
        append_last_motion();
    PLAIT_TRY(submit());
    const auto ways = roots_.rescale(device(), ratio);
    if (!ways)
        return ways.error();
    frame_.rescale(ratio);
    colliders_.rescale(scale, *ways);
    if (!motion_.has_begun()) // it says where they are
        colliders_.place();
    bending_.rescale(scale);
    motion_.rescale(ratio);
    volume_.carries = volume_.carries && !params_.grid.in_world;
    scale_ = display_.scale = scale;
    resized_ = true;
    if (std::ranges::any_of(ways->to, [](float way) { return way != 0; })) {
        plait_pose motion = identity_pose;
        std::ranges::copy(ways->to, motion.t);
        for (size_t i = 0; i < 3 && wind_.blows(); ++i) // its eddies
            wind_.moving.way[i] += double(ways->to[i]);
        model_->carry(schedule_, present(), motion);
        roots_.append_poses(schedule_, 1, state_.pose);
    }
    append_stopped_pins(schedule_, layout_, state_, scale_);
    PLAIT_TRY(submit());
    size_t before = 0;
    const auto set_off = [&](const Group& group) -> Status {
        PLAIT_TRY(roots_.fill_next(device(), 1 - 1.0 / group.substeps, pose_next_));
        model_->set_off(schedule_, at(group, 0), pose_before_[before++], pose_was_, pose_next_, 0);
        return submit();
    };
    if (!moves)
        return {};
    PLAIT_TRY(for_each_group(set_off));
    model_->publish(schedule_, present());
    return submit();
}

} // namespace plait
