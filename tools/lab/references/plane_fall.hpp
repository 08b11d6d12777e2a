// A strand let go in a plane, from Lagrange's equations in the angles of its segments: a reference
// that shares nothing with the models but their masses and the law of their joints.
#pragma once

#include "statics.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace lab {

struct PlaneFall {
    std::vector<double> lengths;       // m; they do not change
    std::vector<double> masses;        // of every vertex, the root's included, kg
    std::vector<double> angles;        // of every segment above the horizontal at rest, radians
    double bend_stiffness = 0;         // EI, N m^2; 0: the root is a hinge
    double gravity = 9.80665;          // m/s^2, downwards
    double drag = 0;                   // 1/s
    JointLaw law = JointLaw::cosserat; // held at the root by half a joint
};

// Positions of all vertices from the root, x and y up, m: at `frames` + 1 times `interval` s apart,
// from rest on. Runge-Kutta 4, with so many steps in each interval; 0: as many as stability and
// 2e-3 sqrt(L/g) ask for.
std::vector<std::vector<Eigen::Vector2d>> fall_in_plane(const PlaneFall& strand, uint32_t frames,
                                                        double interval, uint32_t steps = 0);

} // namespace lab
