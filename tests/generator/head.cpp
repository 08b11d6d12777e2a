#include "support.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace plait_generator {
namespace {

Vec3 triangle_normal(const HeadMesh& mesh, size_t t) {
    const Vec3 a = point(mesh.positions, mesh.triangles[t]);
    return cross(point(mesh.positions, mesh.triangles[t + 1]) - a,
                 point(mesh.positions, mesh.triangles[t + 2]) - a);
}

// Where the ray from `from` along `way`, which starts inside, leaves the head.
Vec3 surface_along(Vec3 from, Vec3 way) {
    double inside = 0, outside = 0.4;
    for (int i = 0; i < 60; ++i) {
        const double middle = (inside + outside) / 2;
        (head_distance(from + middle * way) < 0 ? inside : outside) = middle;
    }
    return from + inside * way;
}

// Half-edges without their other half, and those of more triangles than one.
struct Edges {
    size_t open = 0, shared = 0;
};

Edges edges_of(const HeadMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            ++edges[{mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]}];
    Edges counted;
    for (const auto& [edge, count] : edges) {
        const auto other = edges.find({edge.second, edge.first});
        counted.open += other == edges.end() || other->second != count;
        counted.shared += count > 1;
    }
    return counted;
}

TEST(Head, IsClosedAndConsistentlyOriented) {
    for (unsigned detail = 1; detail <= 3; ++detail) {
        const Edges edges = edges_of(make_head(detail));
        EXPECT_EQ(edges.open, 0u) << "half-edges at detail " << detail;
        EXPECT_LE(edges.shared, detail == 2 ? 0u : 8u)
            << "surfaces that touch, at detail " << detail;
    }
}

TEST(Head, ConsistsOfThreeClosedParts) {
    const HeadParts parts = make_head_parts();
    std::vector<std::pair<double, double>> heights;
    for (const HeadMesh* part : {&parts.head, &parts.neck, &parts.torso}) {
        const Edges edges = edges_of(*part);
        EXPECT_EQ(edges.open, 0u);
        EXPECT_EQ(edges.shared, 0u);
        double low = 1, high = -1;
        for (size_t i = 0; i < part->positions.size() / 3; ++i) {
            const Vec3 p = point(part->positions, i);
            ASSERT_LT(head_distance(p), 1e-6) << "vertex " << i;
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        heights.emplace_back(low, high);
    }
    EXPECT_LT(heights[0].first, heights[1].second - 0.01) << "they overlap";
    EXPECT_LT(heights[1].first, heights[2].second - 0.01) << "they overlap";
}

// Of the whole, so that hair between them meets what is drawn.
TEST(Head, IsTheUnionOfItsParts) {
    const HeadMesh mesh = make_head(1);
    const HeadParts parts = make_head_parts();
    for (size_t i = 0; i < mesh.positions.size() / 3; ++i) {
        const Vec3 p = point(mesh.positions, i);
        double nearest = 1;
        for (const HeadMesh* part : {&parts.head, &parts.neck, &parts.torso})
            for (size_t k = 0; k < part->positions.size() / 3; ++k)
                nearest = std::min(nearest, length(point(part->positions, k) - p));
        ASSERT_LT(nearest, 0.012) << "vertex " << i;
    }
}

TEST(Head, VerticesLieOnTheSurfaceWithItsNormals) {
    const HeadMesh mesh = make_head();
    for (size_t i = 0; i < mesh.positions.size() / 3; ++i) {
        const Vec3 p = point(mesh.positions, i), n = point(mesh.normals, i);
        ASSERT_NEAR(head_distance(p), 0, 1e-7) << "vertex " << i;
        ASSERT_NEAR(length(n), 1, 1e-6) << "vertex " << i;
        ASSERT_GT(head_distance(p + 1e-4 * n), 0) << "vertex " << i;
    }
}

TEST(Head, TrianglesFaceOutwards) {
    const HeadMesh mesh = make_head();
    size_t flipped = 0;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        flipped += dot(triangle_normal(mesh, t), point(mesh.normals, mesh.triangles[t])) < 0;
    EXPECT_LE(flipped, mesh.triangles.size() / 3 / 200) << "creases of the ears and lids apart";
}

TEST(Head, HasTheMeasuresOfAnAdult) {
    const double top = surface_along({0, 0, 0}, {0, 1, 0}).y;
    const double chin = surface_along({0, -0.06, 0.075}, {0, -1, 0}).y;
    EXPECT_NEAR(top - chin, 0.240, 0.002);
    EXPECT_NEAR(surface_along({0, 0.036, -0.01}, {1, 0, 0}).x, 0.153 / 2, 0.0005);
    const double length =
        surface_along({0, 0.04, 0}, {0, 0, 1}).z - surface_along({0, 0.03, 0}, {0, 0, -1}).z;
    EXPECT_NEAR(length, 0.2045, 0.0015);
}

TEST(Head, IsSymmetric) {
    const HeadMesh mesh = make_head(1);
    for (size_t i = 0; i < mesh.positions.size() / 3; ++i) {
        const Vec3 p = point(mesh.positions, i);
        ASSERT_NEAR(head_distance(Vec3{-p.x, p.y, p.z}), 0, 1e-7);
    }
}

TEST(Head, DetailSetsTheNumberOfTriangles) {
    const size_t coarse = make_head(1).triangles.size() / 3,
                 usual = make_head(2).triangles.size() / 3;
    EXPECT_GT(coarse, 3000u);
    EXPECT_GT(usual, 3 * coarse);
    EXPECT_LT(usual, 20000u);
}

TEST(Head, HairGrowsOnTheScalpOnly) {
    const auto height = [](Vec3 from, Vec3 way) {
        const Vec3 p = surface_along(from, way);
        return scalp_height(p.x, p.y, p.z);
    };
    EXPECT_GT(height({0, 0.03, 0}, {0, 1, 0}), 0) << "crown";
    EXPECT_GT(height({0, 0.03, 0}, {0, 0, -1}), 0) << "back of the head";
    EXPECT_GT(height({0, 0.06, 0}, {1, 0, 0}), 0) << "above the ear";
    EXPECT_LT(height({0, 0.05, 0}, {0, 0, 1}), 0) << "forehead";
    EXPECT_LT(height({0, -0.03, 0}, {0, 0, 1}), 0) << "nose";
    EXPECT_LT(height({0, 0, -0.012}, {1, 0, 0}), 0) << "ear";
    EXPECT_LT(height({0, -0.14, -0.02}, {0, 0, -1}), 0) << "neck";
}

TEST(Colliders, LieInsideTheHead) {
    const HeadMesh mesh = make_head();
    for (const Capsule& capsule : head_colliders())
        for (size_t i = 0; i < mesh.positions.size() / 3; ++i)
            ASSERT_GE(capsule_distance(capsule, point(mesh.positions, i)), 0) << "vertex " << i;
}

TEST(Colliders, FillTheScalp) {
    const HeadMesh mesh = make_head();
    double worst = 0, sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < mesh.positions.size() / 3; ++i) {
        const Vec3 p = point(mesh.positions, i);
        if (scalp_height(p.x, p.y, p.z) <= 0)
            continue;
        double nearest = 1;
        for (const Capsule& capsule : head_colliders())
            nearest = std::min(nearest, capsule_distance(capsule, p));
        worst = std::max(worst, nearest);
        sum += nearest;
        ++count;
    }
    EXPECT_LT(worst, 0.012);
    EXPECT_LT(sum / static_cast<double>(count), 0.004);
}

} // namespace
} // namespace plait_generator
