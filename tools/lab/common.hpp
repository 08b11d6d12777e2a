// What plait-lab shares with the other programs.
#pragma once

#include "common/failure.hpp"
#include "common/handles.hpp"
#include "common/json_fwd.hpp"

#include <Eigen/Geometry>

namespace lab {
using namespace common;
using Vec3 = Eigen::Vector3d;
using Quat = Eigen::Quaterniond;

constexpr double standard_gravity = 9.80665; // m/s^2
constexpr double pi = 3.14159265358979323846;

// The shortest turn from one direction to another, of any lengths.
Quat turn_between(const Vec3& from, const Vec3& to);
} // namespace lab
