// Where a matrix puts a strand's root and how it turns its frame.
#pragma once

#include "backend/reference/base/math.hpp"

#include <Eigen/Core>

namespace plait::reference {

// The root goes where x -> m x + shift takes it; its frame turns by the rotation nearest to m in the
// Frobenius norm, U diag(1, 1, det) V^T of its SVD (Kabsch 1976).
Pose skinned_pose(const Eigen::Matrix3d& m, const Vec3& shift, const Vec3& root);

} // namespace plait::reference
