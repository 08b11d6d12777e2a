#include "hand.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace simulate {

using Eigen::Vector3f;

namespace {

constexpr uint32_t around = 32, along_a_cap = 8;

// Rings from the far side of a, by its cap, along the cone and around b.
HeadMesh mesh_of(const plait_collider_desc& shape) {
    const Vector3f a(shape.a), b(shape.b);
    const float length = (b - a).norm();
    const Vector3f axis = length > 0.0f ? Vector3f((b - a) / length) : Vector3f::UnitX();
    const Vector3f side = axis.unitOrthogonal(), other = axis.cross(side);
    HeadMesh mesh;
    for (uint32_t ring = 0; ring <= 2 * along_a_cap + 1; ++ring) {
        const bool first = ring <= along_a_cap;
        const auto step = static_cast<float>(first ? ring : ring - 1);
        const float angle = (step / (2.0f * along_a_cap) - 0.5f) * std::numbers::pi_v<float>;
        const Vector3f middle = first ? a : b;
        const float radius = first ? shape.radius_a : shape.radius_b;
        for (uint32_t i = 0; i < around; ++i) {
            const float turn = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            mesh.vertices.push_back(middle + radius * (std::sin(angle) * axis +
                                                       std::cos(angle) * (std::cos(turn) * side +
                                                                          std::sin(turn) * other)));
        }
    }
    const auto rings = static_cast<uint32_t>(mesh.vertices.size()) / around;
    for (uint32_t ring = 0; ring + 1 < rings; ++ring)
        for (uint32_t i = 0; i < around; ++i) {
            const uint32_t here = ring * around + i, next = ring * around + (i + 1) % around;
            mesh.triangles.push_back({here, next, here + around});
            mesh.triangles.push_back({next, next + around, here + around});
        }
    return mesh;
}

} // namespace

Hand::Hand(const Collider& collider)
    : shape_(collider.shape), middle_{0.5f * (shape_.a[0] + shape_.b[0]),
                                      0.5f * (shape_.a[1] + shape_.b[1]),
                                      0.5f * (shape_.a[2] + shape_.b[2])},
      motion_(make_keyframed(collider.keyframes)), mesh_(mesh_of(shape_)) {
    shape_.pose = pose(0.0f);
}

plait_pose Hand::pose(float time) const {
    return to_pose(motion_->at(time), middle_);
}

} // namespace simulate
