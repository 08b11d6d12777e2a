#include "hand.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace simulate {

using Eigen::Vector3f;

namespace {

constexpr uint32_t around = 32, along_a_cap = 8;

constexpr float plane_size = 0.6f; // m from the middle of what is drawn of a plane to its sides

// Rings from the far side of a, by its cap, along the cone and around b.
HeadMesh capsule_mesh(const plait_collider_desc& shape) {
    const Vector3f a(shape.capsule.a), b(shape.capsule.b);
    const float length = (b - a).norm();
    const Vector3f axis = length > 0.0f ? Vector3f((b - a) / length) : Vector3f::UnitX();
    const Vector3f side = axis.unitOrthogonal(), other = axis.cross(side);
    HeadMesh mesh;
    for (uint32_t ring = 0; ring <= 2 * along_a_cap + 1; ++ring) {
        const bool first = ring <= along_a_cap;
        const auto step = static_cast<float>(first ? ring : ring - 1);
        const float angle = (step / (2.0f * along_a_cap) - 0.5f) * std::numbers::pi_v<float>;
        const Vector3f middle = first ? a : b;
        const float radius = first ? shape.capsule.radius_a : shape.capsule.radius_b;
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

// A square around its point.
HeadMesh plane_mesh(const plait_collider_desc& shape) {
    const Vector3f normal = Vector3f(shape.plane.normal).normalized();
    const Vector3f side = plane_size * normal.unitOrthogonal(), other = normal.cross(side);
    const Vector3f point(shape.plane.point);
    HeadMesh mesh;
    mesh.vertices = {point - side - other, point + side - other, point + side + other,
                     point - side + other};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

// Of a patch that bends as the box is rounded: its faces, edges and corners are where the sphere
// that rounds it lies in its corners. Each of six faces is a grid whose inner square is flat.
HeadMesh box_mesh(const plait_collider_desc& shape) {
    constexpr int across = 2 * 6; // cells of a quarter turn: of both edges of a face
    const Eigen::Quaternionf turn(shape.box.orientation[3], shape.box.orientation[0],
                                  shape.box.orientation[1], shape.box.orientation[2]);
    const Vector3f half(shape.box.half_extents), centre(shape.box.centre);
    HeadMesh mesh;
    for (int face = 0; face < 6; ++face) {
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        const int axis = face / 2;
        const float side = face % 2 ? -1.0f : 1.0f;
        // in the middle of a face two rows lie on either half of it, so that it stays flat
        for (int row = 0; row < across + 2; ++row)
            for (int column = 0; column < across + 2; ++column) {
                const auto step = [](int k) {
                    const int cell = k > across / 2 ? k - 1 : k;
                    return std::tan((static_cast<float>(cell) / across - 0.5f) *
                                    std::numbers::pi_v<float> / 2);
                };
                const auto half_of = [](int k) { return k > across / 2 ? 1.0f : -1.0f; };
                Vector3f out, corner;
                out[axis] = side;
                out[(axis + 1) % 3] = side * step(row);
                out[(axis + 2) % 3] = step(column);
                corner[axis] = side;
                corner[(axis + 1) % 3] = side * half_of(row);
                corner[(axis + 2) % 3] = half_of(column);
                mesh.vertices.push_back(centre + turn * (half.cwiseProduct(corner) +
                                                         shape.box.rounding * out.normalized()));
            }
        constexpr uint32_t row_size = across + 2;
        for (uint32_t row = 0; row + 1 < row_size; ++row)
            for (uint32_t column = 0; column + 1 < row_size; ++column) {
                const uint32_t here = first + row * row_size + column;
                mesh.triangles.push_back({here, here + row_size, here + 1});
                mesh.triangles.push_back({here + 1, here + row_size, here + row_size + 1});
            }
    }
    return mesh;
}

HeadMesh mesh_of(const plait_collider_desc& shape) {
    switch (shape.kind) {
    case PLAIT_COLLIDER_KIND_PLANE:
        return plane_mesh(shape);
    case PLAIT_COLLIDER_KIND_BOX:
        return box_mesh(shape);
    default:
        return capsule_mesh(shape);
    }
}

std::array<float, 3> middle_of(const plait_collider_desc& shape) {
    const bool plane = shape.kind == PLAIT_COLLIDER_KIND_PLANE;
    const float* const at = plane ? shape.plane.point : shape.box.centre;
    if (shape.kind != PLAIT_COLLIDER_KIND_CAPSULE)
        return {at[0], at[1], at[2]};
    const plait_capsule& c = shape.capsule;
    return {0.5f * (c.a[0] + c.b[0]), 0.5f * (c.a[1] + c.b[1]), 0.5f * (c.a[2] + c.b[2])};
}

} // namespace

Hand::Hand(const Collider& collider)
    : shape_(collider.shape), middle_(middle_of(shape_)),
      motion_(make_keyframed(collider.keyframes)), mesh_(mesh_of(shape_)) {
    shape_.pose = pose(0.0f);
}

plait_pose Hand::pose(float time) const {
    return to_pose(motion_->at(time), middle_);
}

} // namespace simulate
