// Where a caller wants the roots.
#pragma once

#include "core/base/pose.hpp"
#include "core/roots/root_binding.hpp"
#include "core/roots/skin.hpp"

#include <span>

namespace plait {

// A head, and either nothing, a pose per guide, bones for the skin, or where the vertices of the mesh
// are that roots are bound to. Places are in metres of the world, and hair is `scale` times as large as
// the groom, by bones that are scaled still more.
//
// A sim is in the groom's units, of which each is so many metres: what comes in is divided by it, what
// is shown or read is multiplied. Nothing else knows of a scale.
struct RootsInput : RootPoses {
    std::span<BoneMatrix> bones; // taken apart into scale and pose
    std::span<const MeshPoint> mesh;
};

} // namespace plait
