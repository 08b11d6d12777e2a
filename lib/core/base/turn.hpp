#pragma once

#include <Eigen/Geometry>

namespace plait {

// The shortest turn from one direction to another, of any lengths. Where one has none, it turns nothing and is not
// normalised. The backends' own turn takes another axis between opposite directions: docs/backends.md.
Eigen::Quaterniond turn(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

} // namespace plait
