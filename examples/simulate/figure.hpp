// Everything at rest: the groom, the head under it, and what the hair collides with.
#pragma once

#include "head_mesh.hpp"
#include "scene.hpp"

#include <Eigen/Geometry>

#include <memory>

namespace simulate {

struct Figure {
    GroomHandle groom;
    plait_groom_info info;
    HeadMesh head; // may be empty
    std::vector<Collider> colliders;
    std::array<float, 3> pivot;
    std::optional<std::array<float, 2>> neck; // absent: the whole mesh turns
    Eigen::AlignedBox3f hair_bounds;          // at rest

    // The head's mesh when the head is at `pose`; below the neck it stays, in between it twists.
    std::vector<Eigen::Vector3f> posed_head(const plait_pose& pose) const;
};

Figure make_figure(const Scene& scene);

} // namespace simulate
