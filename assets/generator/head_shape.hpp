// The mannequin as a distance field.
#pragma once

#include "vec.hpp"

namespace plait_generator {

// Distance to the surface in metres, negative inside. Blends of exact and first-order distances:
// the gradient's length is 1 within a fifth or so near the surface, and smaller far inside.
double head_distance(Vec3 p);

// The same without ears, in which hair does not grow.
double skull_distance(Vec3 p);

// Outward unit normal of the surface of equal distance through p.
Vec3 head_normal(Vec3 p);

// The nearest point whose distance is `distance`, to 1e-9 m, by Newton's method along the normal.
Vec3 to_distance(Vec3 p, double distance);

} // namespace plait_generator
