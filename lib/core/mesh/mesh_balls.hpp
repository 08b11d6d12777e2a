// Points of a surface, and the largest balls inside that touch it there.
#pragma once

#include "core/mesh/mesh.hpp"

#include <Eigen/Dense>

namespace plait {

using Vec3 = Eigen::Vector3d;

// A point of the surface, and the largest ball inside that touches it.
struct Sample {
    Vec3 x, outward;
    Vec3 middle;
    double radius;
};
using Samples = std::pmr::vector<Sample>;

// So many, evenly over the area; without balls.
Samples spread(const TriangleSet& surface, size_t number, std::pmr::memory_resource* memory);
// `size`: m, of the mesh.
void measure_balls(Samples& samples, double size);

} // namespace plait
