// Where a strand hangs at rest, in float64 and in a plane: the reference for resting shapes.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace lab {

// Bending energy of a joint turned by a from rest, of length l and stiffness EI.
enum class JointLaw {
    angle,   // EI a^2 / 2l
    cosserat // 4 EI (1 - cos(a/2)) / l: the energy the rods are simulated with
};

struct PlaneRod {
    std::vector<double> lengths;  // of the segments, m
    double clamp = 0;             // angle of the first one at rest, rad above the horizontal
    double curvature = 0;         // of the rest shape, 1/m, positive turns anticlockwise
    double bend_stiffness = 1;    // EI, N m^2, > 0
    double stretch_stiffness = 0; // EA, N; 0: cannot stretch or shear
    double line_density = 1;      // kg/m
    double gravity = 1;           // m/s^2, downwards
    JointLaw law = JointLaw::cosserat;
};

// Vertices (x, y) from the root at the origin, m: half a joint at the clamp, half a mass at the
// tip. Weight is put on little by little, so that the shape is the one a strand falls into. Empty
// where that does not converge.
std::vector<Eigen::Vector2d> hanging_shape(const PlaneRod& rod);

// The tip of the continuous rod of the same length, by extrapolation from finer and finer ones.
Eigen::Vector2d elastica_tip(PlaneRod rod);

} // namespace lab
