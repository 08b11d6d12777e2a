#include "core/base/frame.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>
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

namespace {

// m, of a frame about a metre in size.
double way_between(const plait_pose& from, const plait_pose& to) {
    float turned[4];
    turn(from, to, turned);
    double square = 0;
    for (size_t i = 0; i < 3; ++i)
        square += std::pow(double(to.t[i]) - double(from.t[i]), 2) + std::pow(double(turned[i]), 2);
    return std::sqrt(square);
}

} // namespace

bool Frame::aim(const plait_frame_desc* desc) {
    if (!desc) {
        const bool carried = known_ >= its_way;
        const plait_pose unfelt = unfelt_;
        *this = {};
        unfelt_ = unfelt; // of the step that was
        return carried;
    }
    const bool otherwise =
        felt_translation_ != desc->felt_translation || felt_rotation_ != desc->felt_rotation;
    target_ = desc->pose;
    if (known_ == no_frame)
        at_ = from_ = to_ = target_;
    else if (way_between(along_, target_) < way_between(at_, target_))
        at_ = from_ = to_ = along_;
    along_ = at_;
    const bool changes = known_ == its_place || (known_ >= its_way && otherwise);
    known_ = std::max(known_, std::min<uint32_t>(known_ + 1, its_way));
    air_ = desc->air;
    felt_translation_ = desc->felt_translation;
    felt_rotation_ = desc->felt_rotation;
    return changes;
}

void Frame::arrive() {
    if (same_pose(along_, at_))
        along_ = target_;
    at_ = target_;
}

void Frame::advance(double end) {
    unfelt_then_ = known_ == way_before ? std::optional(unfelt_part()) : std::nullopt;
    from_ = to_;
    to_ = interpolate(at_, target_, end);
    unfelt_before_ = unfelt_;
    unfelt_ = unfelt_part();
    if (known_ == its_way)
        known_ = way_before;
}

std::optional<std::pair<plait_pose, plait_pose>> Frame::driven(double end, double part) const {
    if (known_ != its_way || end >= part)
        return std::nullopt;
    return std::pair(carried(at_, interpolate(at_, target_, part - end), at_),
                     interpolate(at_, target_, end));
}

void Frame::jump(double end) {
    advance(end);
    from_ = to_;
}

void Frame::rescale(double ratio) {
    for (plait_pose* pose : {&at_, &target_, &from_, &to_, &unfelt_before_, &unfelt_, &along_})
        plait::rescale(*pose, ratio);
}

// About the frame's origin.
plait_pose Frame::part(double translation, double rotation) const {
    if (!is_on())
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

plait_pose Frame::unfelt_part() const {
    return part(1.0 - double(felt_translation_), 1.0 - double(felt_rotation_));
}

std::array<float, 3> Frame::air(const float p[3], double step) const {
    std::array<float, 3> velocity{};
    if (!is_on() || air_ == PLAIT_FRAME_AIR_UNFELT)
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
    return {known_,
            static_cast<uint32_t>(air_),
            felt_translation_,
            felt_rotation_,
            at_,
            target_,
            from_,
            to_,
            unfelt_,
            along_};
}

void Frame::restore(const State& state) {
    known_ = state.known;
    air_ = static_cast<plait_frame_air>(state.air);
    felt_translation_ = state.felt_translation;
    felt_rotation_ = state.felt_rotation;
    at_ = state.at;
    target_ = state.target;
    from_ = state.from;
    to_ = state.to;
    unfelt_ = state.unfelt;
    along_ = state.along;
}

} // namespace plait
