// A frame of reference that carries the hair and is felt by a share: a vehicle, a lift, a horse.
#pragma once

#include "core/base/pose.hpp"

#include <array>
#include <optional>
#include <utility>

namespace plait {

plait_frame_desc default_frame_desc();
// The pose's quaternion is normalised. INVALID_ARGUMENT names the field, its value and its range.
Result<plait_frame_desc> checked_frame(const plait_frame_desc& desc);

// On the same path as the roots: `at` and `target` of the call, `from` and `to` of the fixed step.
class Frame {
  public:
    // Where it will be at the end of the next call; a frame that is new is there at once. Null: none.
    // True: what hair feels of the head's motion is not what it felt in the step before.
    bool aim(const plait_frame_desc* desc);
    bool is_on() const { return known_ > no_frame; }
    // As Roots.
    void advance(double end);
    // Where the way of a step of `part` of the call is the first that is known, and began before the call: its
    // begin and end, had the frame driven on as now.
    std::optional<std::pair<plait_pose, plait_pose>> driven(double end, double part) const;
    void come_from(const plait_pose& pose) { to_ = pose; }
    void arrive();
    void stop() { from_ = to_ = at_; }
    void jump(double end);
    // The head was put elsewhere, from one pose to the other: if the next aim is nearer to where that
    // would put the frame than to where it is, the frame went along.
    void leave(const plait_pose& from, const plait_pose& to) { along_ = carried(along_, from, to); }
    // As Roots, with its target.
    void rescale(double ratio);

    // The part of the step's motion that hair does not feel, p -> q*p + t, and of the step before; the
    // identity without a frame.
    const plait_pose& unfelt() const { return unfelt_; }
    const plait_pose& unfelt_before() const { return unfelt_before_; }
    // The whole motion of the step.
    plait_pose motion() const { return part(1, 1); }
    // The part of the motion in the step before that hair would not have felt by the shares of now, where
    // that motion is known.
    const std::optional<plait_pose>& unfelt_then() const { return unfelt_then_; }
    // m/s by which the wind's air moves at the point `p` of the world, in the step of `step` s, relative
    // to what is carried along unfelt.
    std::array<float, 3> air(const float p[3], double step) const;

    // What snapshots hold.
    struct State {
        uint32_t known = 0; // Frame::known_
        uint32_t air = 0;
        float felt_translation = 1, felt_rotation = 1;
        plait_pose at = identity_pose, target = identity_pose;
        plait_pose from = identity_pose, to = identity_pose, unfelt = identity_pose;
        plait_pose along = identity_pose;
    };
    State state() const;
    void restore(const State& state);

  private:
    plait_pose part(double translation, double rotation) const;
    plait_pose unfelt_part() const;

    // way_before: its way in the step before, too.
    enum Known : uint32_t { no_frame, its_place, its_way, way_before };
    uint32_t known_ = no_frame;
    plait_frame_air air_ = PLAIT_FRAME_AIR_UNFELT;
    float felt_translation_ = 1, felt_rotation_ = 1;
    plait_pose at_ = identity_pose, target_ = identity_pose;
    plait_pose from_ = identity_pose, to_ = identity_pose;
    plait_pose unfelt_before_ = identity_pose, unfelt_ = identity_pose;
    plait_pose along_ = identity_pose; // at_, taken along with the head that was put elsewhere
    std::optional<plait_pose> unfelt_then_;
};

} // namespace plait
