#include "core/base/frame.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cstring>

namespace plait {

plait_frame_desc default_frame_desc() {
    plait_frame_desc desc{};
    desc.struct_size = sizeof desc;
    desc.pose = identity_pose;
    desc.felt_translation = 0;
    desc.felt_rotation = 0;
    desc.air = PLAIT_FRAME_AIR_UNFELT;
    return desc;
}

Result<plait_frame_desc> checked_frame(const plait_frame_desc& desc) {
    const auto pose = checked_pose(desc.pose, "frame.pose");
    if (!pose)
        return pose.error();
    for (const auto& [name, share] : {std::pair{"felt_translation", desc.felt_translation},
                                      std::pair{"felt_rotation", desc.felt_rotation}})
        if (!(share >= 0 && share <= 1))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("frame.%s is %g, range is [0, 1]", name, double(share))};
    int32_t air; // a C caller may have put anything there
    std::memcpy(&air, &desc.air, sizeof air);
    if (air < PLAIT_FRAME_AIR_UNFELT || air > PLAIT_FRAME_AIR_WORLD)
        return Error{PLAIT_INVALID_ARGUMENT, format("frame.air is %d, range is [0, 2]", air)};
    plait_frame_desc checked = desc;
    checked.pose = *pose;
    return checked;
}

bool Frame::aim(const plait_frame_desc* desc) {
    if (!desc) {
        const bool carried = aims_ == 2;
        const plait_pose unfelt = unfelt_;
        *this = {};
        unfelt_ = unfelt; // of the step that was
        return carried;
    }
    const bool otherwise =
        felt_translation_ != desc->felt_translation || felt_rotation_ != desc->felt_rotation;
    target_ = desc->pose;
    if (aims_ == 0)
        at_ = from_ = to_ = target_;
    const bool changes = aims_ == 1 || (aims_ == 2 && otherwise);
    aims_ = std::min(aims_ + 1, 2u);
    air_ = desc->air;
    felt_translation_ = desc->felt_translation;
    felt_rotation_ = desc->felt_rotation;
    return changes;
}

void Frame::advance(double end) {
    from_ = to_;
    to_ = interpolate(at_, target_, end);
    unfelt_before_ = unfelt_;
    unfelt_ = part(1.0 - double(felt_translation_), 1.0 - double(felt_rotation_));
}

void Frame::jump(double end) {
    advance(end);
    from_ = to_;
}

void Frame::rescale(double ratio) {
    for (plait_pose* pose : {&at_, &target_, &from_, &to_, &unfelt_before_, &unfelt_})
        plait::rescale(*pose, ratio);
}

// About the frame's origin.
plait_pose Frame::part(double translation, double rotation) const {
    if (aims_ == 0)
        return identity_pose;
    plait_pose motion = identity_pose;
    turn(from_, to_, motion.q);
    motion = interpolate(identity_pose, motion, rotation);
    float origin[3];
    transform(motion, from_.t, origin);
    for (size_t i = 0; i < 3; ++i)
        motion.t[i] = static_cast<float>(double(from_.t[i]) - origin[i] +
                                         translation * (double(to_.t[i]) - from_.t[i]));
    return motion;
}

std::array<float, 3> Frame::air(const float p[3], double step) const {
    std::array<float, 3> velocity{};
    if (aims_ == 0 || air_ == PLAIT_FRAME_AIR_UNFELT)
        return velocity;
    const plait_pose air = air_ == PLAIT_FRAME_AIR_FRAME ? part(1, 1) : identity_pose;
    float with_air[3], with_hair[3];
    transform(air, p, with_air);
    transform(unfelt_, p, with_hair);
    for (size_t i = 0; i < 3; ++i)
        velocity[i] = static_cast<float>((double(with_air[i]) - with_hair[i]) / step);
    return velocity;
}

Frame::State Frame::state() const {
    return {
        aims_, static_cast<uint32_t>(air_), felt_translation_, felt_rotation_, at_, target_, from_,
        to_};
}

void Frame::restore(const State& state) {
    aims_ = state.aims;
    air_ = static_cast<plait_frame_air>(state.air);
    felt_translation_ = state.felt_translation;
    felt_rotation_ = state.felt_rotation;
    at_ = state.at;
    target_ = state.target;
    from_ = state.from;
    to_ = state.to;
    unfelt_ = state.unfelt;
}

} // namespace plait
