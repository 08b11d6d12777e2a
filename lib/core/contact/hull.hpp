// Convex bodies with flat faces, of closed convex meshes.
#pragma once

#include "core/mesh/mesh.hpp"

#include <span>

namespace plait {

// All x with normal.x <= distance; unit and outward, m from the hull's centre.
using HullFace = std::array<float, 4>; // normal, distance

struct Hull {
    explicit Hull(std::pmr::memory_resource* memory) : faces(memory) {}

    std::array<float, 3> centre{}, half_extents{}; // of the box around it
    std::pmr::vector<HullFace> faces;              // the greatest triangle's first
};

struct HullRules {
    double tolerance; // of the mesh's size
    bool margin; // faces are to be moved out: those of the box around it are among them then, so
                 // that sharp edges do not run far
};

// INVALID_ARGUMENT: the mesh has no inside, is flat, too large, not convex, or has too many faces. `hull`
// keeps its memory.
Status make_hull(const Mesh& mesh, const HullRules& rules, Hull& hull);
// What holds of every hull: of faces from a snapshot, too. INVALID_ARGUMENT.
Status check_hull_faces(std::span<const HullFace> faces);

} // namespace plait
