// From the axes of a file to plait's, where a turn and an offset follow, and back.
#pragma once

#include <plait/plait.h>

#include <span>

namespace plait {

// Left-handed axes are reflected: triangles change their sense.
bool reflects(plait_axes axes);

// `positions`: xyz of points, in metres. `pose`: of a unit quaternion.
void place_points(std::span<float> positions, plait_axes axes, const plait_pose& pose);

// The reverse of what place_points does with `axes`, of one point in plait's axes.
void turn_to_axes(float* point, plait_axes axes);

} // namespace plait
