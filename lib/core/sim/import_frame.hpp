// Where what is imported comes to lie: its axes, then a turn and an offset.
#pragma once

#include <plait/plait.h>

#include <span>

namespace plait {

// Left-handed axes are reflected: triangles change their sense.
bool reflects(plait_axes axes);

// `positions`: xyz of points, in metres. `pose`: of a unit quaternion.
void place_points(std::span<float> positions, plait_axes axes, const plait_pose& pose);

} // namespace plait
