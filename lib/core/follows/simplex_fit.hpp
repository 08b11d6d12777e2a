// Least squares of a few weights that are not negative and sum to 1.
#pragma once

#include <Eigen/Core>

namespace plait {

// The w that minimises w'Hw - 2 b'w, w >= 0, sum 1, of the first `count` [1, 4]; the others are 0.
// H is symmetric and positive definite.
Eigen::Vector4d fit_on_simplex(const Eigen::Matrix4d& h, const Eigen::Vector4d& b, int count);

} // namespace plait
