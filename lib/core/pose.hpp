// Poses on the host: checks and interpolation as the stage `roots` does it.
#pragma once

#include "base/result.hpp"

#include <plait/plait.h>

namespace plait {

inline constexpr plait_pose identity_pose = {{0, 0, 0, 1}, {0, 0, 0}};

// A finite pose with its quaternion normalised. INVALID_ARGUMENT if |q| is off 1 by over 1e-3;
// `name` says which pose it is.
Result<plait_pose> checked_pose(const plait_pose& pose, const char* name);

// Normalised linear blend of the rotations along the shorter arc, linear blend of translations.
plait_pose interpolate(const plait_pose& from, const plait_pose& to, double share);

// The unit quaternion, x y z w, that turns the orientation of `from` into that of `to`; exactly
// the identity for equal ones.
void turn(const plait_pose& from, const plait_pose& to, float out[4]);

// The rotation of `after` after that of `first`, a unit quaternion, x y z w.
void rotation_product(const plait_pose& after, const plait_pose& first, float out[4]);

// Whether a body lies to the head after a jump as it did before, but for rounding.
bool goes_along(const plait_pose& head_before, const plait_pose& body_before,
                const plait_pose& head_after, const plait_pose& body_after);

// q*p + t
void transform(const plait_pose& pose, const float p[3], float out[3]);

} // namespace plait
