// The motion of a head in a substep, and whether it differs from that of the one before.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

namespace plait::reference {

// x -> to from^-1 x.
class RigidMotion {
  public:
    RigidMotion(const Pose& from, const Pose& to) : from_(from), to_(to) {}

    Vec3 undo(const Vec3& x) const { return from_.apply(to_.invert(x)); }
    Quat turn() const { return to_.q * from_.q.conjugate(); }

  private:
    Pose from_, to_;
};

// `pose` after the rigid motion that takes `from` to `to`.
inline Pose carried(const Pose& pose, const Pose& from, const Pose& to) {
    const Quat turn = to.q * from.q.conjugate();
    return {turn * pose.q, to.apply(from.invert(pose.t))};
}

// Whether the ways here of a root that is at `root` now differ by a speed of `jump` or more.
inline bool sets_off(const RigidMotion& was, const RigidMotion& is, const Vec3& root,
                     const plait_set_off_params& params) {
    const Vec3 way = is.undo(root) - was.undo(root);
    const Quat change = is.turn().conjugate() * was.turn();
    const Vec3 turn = 2 * PLAIT_SET_OFF_REACH * change.vec();
    const double least = double(params.jump) * params.h;
    return way.squaredNorm() + turn.squaredNorm() >= least * least;
}

} // namespace plait::reference
