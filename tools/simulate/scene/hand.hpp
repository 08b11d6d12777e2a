// Colliders with a motion of their own, such as a hand that strokes the hair.
#pragma once

#include "head_mesh.hpp"
#include "motion.hpp"
#include "scene.hpp"

#include <memory>

namespace simulate {

class Hand {
  public:
    explicit Hand(const Collider& collider); // which has keyframes

    const plait_collider_desc& shape() const { return shape_; } // its pose is that of time 0
    plait_pose pose(float time) const;                          // s
    const HeadMesh& mesh() const { return mesh_; }              // without its pose

  private:
    plait_collider_desc shape_;
    std::array<float, 3> middle_; // about which it turns
    std::shared_ptr<const Motion> motion_;
    HeadMesh mesh_;
};

} // namespace simulate
