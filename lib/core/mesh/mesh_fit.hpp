// Rounded cones that stand for a mesh together: two balls of their own sizes each, and all between.
#pragma once

#include "core/mesh/mesh.hpp"

#include <span>

namespace plait {

struct FittedCone {
    MeshPoint a, b;           // m
    float radius_a, radius_b; // m, > 0
};

// How far the surface of the mesh is from that of all cones together, m.
struct FitError {
    double rms = 0;
    double percentile_99 = 0;
    double greatest = 0;
};

// As many cones as there is room for. The same mesh gives the same cones.
FitError fit_cones(const Mesh& mesh, std::span<FittedCone> cones);

} // namespace plait
