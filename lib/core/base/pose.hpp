// Poses on the host: checks and interpolation.
#pragma once

#include "base/result.hpp"

#include <plait/params.h>
#include <plait/plait.h>

#include <array>
#include <span>

namespace plait {

inline constexpr plait_pose identity_pose = {{0, 0, 0, 1}, {0, 0, 0}};

// `pose`, whose place is in metres, where `scale` of them are one of the groom's.
plait_pose in_units(const plait_pose& pose, float scale);
// `pose` in units of which there are `ratio` times as many.
void rescale(plait_pose& pose, double ratio);

// By how much a head's places in the groom's units are others since these are other ones: of the call,
// and of the step before and this one.
struct HeadWays {
    using Way = std::array<float, 3>;
    Way at{}, before{}, from{}, to{};
};

bool same_pose(const plait_pose& a, const plait_pose& b);

// A finite pose with its quaternion normalised. INVALID_ARGUMENT if |q| is off 1 by over 1e-3;
// `name` says which pose it is.
Result<plait_pose> checked_pose(const plait_pose& pose, const char* name);

// At one angular velocity along the shorter arc, and at one velocity of the translation.
plait_pose interpolate(const plait_pose& from, const plait_pose& to, double share);

// At `share` of the way from `from` to `to` on the parabola through `before`, which lies as long ago as
// the way takes; rotations are blended likewise and normalised.
plait_pose on_parabola(const plait_pose& before, const plait_pose& from, const plait_pose& to,
                       double share);

// `pose` after the rigid motion that takes `from` to `to`.
plait_pose carried(const plait_pose& pose, const plait_pose& from, const plait_pose& to);

// The unit quaternion, x y z w, that turns the orientation of `from` into that of `to`; exactly
// the identity for equal ones.
void turn(const plait_pose& from, const plait_pose& to, float out[4]);

// The rotation of `after` after that of `first`, a unit quaternion, x y z w.
void rotation_product(const plait_pose& after, const plait_pose& first, float out[4]);

// Of the stages tressfx_carry and lane_carry.
plait_carry_params carry_params(const plait_pose& motion, uint32_t row, uint32_t tile,
                                bool history);

// Whether a body lies to the head after a jump as it did before, but for rounding.
bool goes_along(const plait_pose& head_before, const plait_pose& body_before,
                const plait_pose& head_after, const plait_pose& body_after);

// q*p + t
void transform(const plait_pose& pose, const float p[3], float out[3]);

// Where roots are: a head, and a pose for each strand or none; hair is `scale` times as large as the
// groom.
struct RootPoses {
    plait_pose head = identity_pose;
    float scale = 1;
    std::span<const plait_pose> own;
};

} // namespace plait
