#pragma once

#include <Eigen/Geometry>

namespace plait {

// The shortest turn from one direction to another, of any lengths but 0.
Eigen::Quaterniond turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

} // namespace plait
