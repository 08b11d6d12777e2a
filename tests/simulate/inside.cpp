// What lies inside a mesh, and how deep, where the answer is known.
#include "render/inside.hpp"

#include <gtest/gtest.h>

#include <cmath>

using Eigen::Vector3f;

namespace {

struct Shape {
    std::vector<Vector3f> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
};

// A cube of half a metre from its middle, outwards; `sides` of its six, the top last.
Shape cube(const Vector3f& middle, size_t sides = 6) {
    Shape shape;
    for (int corner = 0; corner < 8; ++corner)
        shape.vertices.push_back(middle + Vector3f(corner & 1 ? 0.5f : -0.5f,
                                                   corner & 2 ? 0.5f : -0.5f,
                                                   corner & 4 ? 0.5f : -0.5f));
    constexpr std::array<uint32_t, 4> quads[6] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                  {0, 2, 3, 1}, {4, 5, 7, 6}, {2, 6, 7, 3}};
    for (size_t side = 0; side < sides; ++side) {
        const auto& [a, b, c, d] = quads[side];
        shape.triangles.push_back({a, b, c});
        shape.triangles.push_back({a, c, d});
    }
    return shape;
}

Shape both(Shape a, const Shape& b) {
    const auto first = static_cast<uint32_t>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [i, j, k] : b.triangles)
        a.triangles.push_back({first + i, first + j, first + k});
    return a;
}

struct Filled : render::Solid {
    explicit Filled(const Shape& shape) : Solid(shape.triangles) { set_vertices(shape.vertices); }
};

TEST(Inside, a_cube_is_as_deep_as_its_nearest_side) {
    const Filled solid(cube({0, 0, 0}));
    EXPECT_NEAR(solid.winding_number({0.1f, 0.2f, 0.3f}), 1, 1e-9);
    EXPECT_NEAR(solid.winding_number({0.1f, 0.2f, 0.7f}), 0, 1e-9);
    EXPECT_NEAR(solid.depth({0.1f, 0.2f, 0.3f}), 0.2f, 1e-6f);
    EXPECT_NEAR(solid.depth({-0.45f, 0.2f, 0.3f}), 0.05f, 1e-6f);
    EXPECT_EQ(solid.depth({0.1f, 0.2f, 0.501f}), 0.0f);
    EXPECT_EQ(solid.depth({0.51f, 0.51f, 0.51f}), 0.0f);
    EXPECT_EQ(solid.depth({5, 0, 0}), 0.0f) << "far";
}

// The rays of a point on a cube's diagonal meet edges and corners, too.
TEST(Inside, every_place_of_a_lattice_is_told) {
    const Filled solid(cube({0, 0, 0}));
    for (int i = -7; i <= 7; ++i)
        for (int j = -7; j <= 7; ++j)
            for (int k = -7; k <= 7; ++k) {
                const Vector3f p = 0.1f * Vector3f(static_cast<float>(i), static_cast<float>(j),
                                                   static_cast<float>(k));
                const float out = p.cwiseAbs().maxCoeff() - 0.5f;
                if (std::abs(out) > 1e-3f) {
                    EXPECT_NEAR(solid.depth(p), std::max(0.0f, -out), 1e-6f) << p.transpose();
                }
            }
}

TEST(Inside, a_mesh_that_moves_takes_its_inside_along) {
    Filled solid(cube({0, 0, 0}));
    solid.set_vertices(cube({2, 0, 0}).vertices);
    EXPECT_EQ(solid.depth({0, 0, 0}), 0.0f);
    EXPECT_NEAR(solid.depth({2, 0, 0}), 0.5f, 1e-6f);
}

TEST(Inside, parts_may_overlap) {
    const Filled solid(both(cube({0, 0, 0}), cube({0.6f, 0, 0})));
    EXPECT_NEAR(solid.winding_number({0.3f, 0, 0}), 2, 1e-6);
    EXPECT_NEAR(solid.depth({0.3f, 0, 0}), 0.2f, 1e-6f);
    EXPECT_NEAR(solid.depth({-0.3f, 0, 0}), 0.2f, 1e-6f);
    EXPECT_GT(solid.depth({0.9f, 0, 0}), 0.1f);
}

TEST(Inside, triangles_may_all_look_inwards) {
    Shape shape = cube({0, 0, 0});
    for (auto& [a, b, c] : shape.triangles)
        std::swap(b, c);
    const Filled solid(shape);
    EXPECT_NEAR(solid.depth({0.3f, 0, 0}), 0.2f, 1e-6f);
    EXPECT_EQ(solid.depth({0.6f, 0, 0}), 0.0f);
}

// Without its top: above the middle of the opening the mesh winds by less than a half.
TEST(Inside, a_hole_is_closed_where_the_mesh_winds_by_a_half) {
    const Filled solid(cube({0, 0, 0}, 5));
    EXPECT_NEAR(solid.winding_number({0, 0.5f, 0}), 0.5, 1e-6);
    EXPECT_GT(solid.depth({0, 0.4f, 0}), 0.4f);
    EXPECT_EQ(solid.depth({0, 0.51f, 0}), 0.0f);
    EXPECT_EQ(solid.depth({0.2f, 0.7f, 0.1f}), 0.0f);
    EXPECT_GT(solid.depth({-0.4f, -0.4f, 0.4f}), 0.09f);
}

} // namespace
