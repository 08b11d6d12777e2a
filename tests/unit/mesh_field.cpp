// Distances to meshes: exact ones against closed forms and against another way to reckon them, and
// those of the field against the exact ones.
#include "core/mesh/mesh_field.hpp"
#include "core/mesh/mesh_distance.hpp"

#include "../api/mesh_shapes.hpp"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;

RawMesh raw_of(const ShapeMesh& shape) {
    RawMesh raw(std::pmr::get_default_resource());
    raw.surface.positions.assign(shape.positions.begin(), shape.positions.end());
    raw.surface.triangles.assign(shape.triangles.begin(), shape.triangles.end());
    return raw;
}

Mesh mesh_of(const ShapeMesh& shape) {
    Mesh mesh(std::pmr::get_default_resource());
    const Status status = build_mesh(raw_of(shape), PLAIT_REPAIR_POLICY_REFUSE, "", mesh);
    EXPECT_TRUE(status.ok()) << status.error().message;
    return mesh;
}

MeshField field_of(const Mesh& mesh, uint32_t cells, bool two_sided = false) {
    MeshField field(std::pmr::get_default_resource());
    const Status status = bake_field(mesh, {cells, two_sided}, field);
    EXPECT_TRUE(status.ok()) << status.error().message;
    return field;
}

class Points {
  public:
    Vec3 in_cube(double half) { return Vec3(next(), next(), next()) * half; }

  private:
    double next() { return uniform_(random_); }
    std::mt19937 random_{3};
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

Vec3 corner(const TriangleSet& surface, const Triangle& t, size_t k) {
    const MeshPoint& p = surface.positions[t[k]];
    return {double(p[0]), double(p[1]), double(p[2])};
}

double to_segment(const Vec3& a, const Vec3& b, const Vec3& x) {
    const Vec3 ab = b - a;
    return (x - a - std::clamp(ab.dot(x - a) / ab.squaredNorm(), 0.0, 1.0) * ab).norm();
}

// By the plane where the foot is on the same side of all edges, else by the edges.
double to_triangle(const Vec3 (&p)[3], const Vec3& x) {
    const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    double least = INFINITY;
    bool over = true;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 &from = p[k], &to = p[(k + 1) % 3];
        over = over && n.dot((to - from).cross(x - from)) >= 0;
        least = std::min(least, to_segment(from, to, x));
    }
    return over ? std::min(least, std::abs(n.dot(x - p[0]))) : least;
}

// Distance, negative where the solid angles of all triangles add up to the whole sphere (Van
// Oosterom & Strackee 1983).
double searched(const TriangleSet& surface, const Vec3& x) {
    double least = INFINITY, turns = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3 p[3] = {corner(surface, t, 0), corner(surface, t, 1), corner(surface, t, 2)};
        least = std::min(least, to_triangle(p, x));
        const Vec3 a = p[0] - x, b = p[1] - x, c = p[2] - x;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        turns += std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return turns > full_turn / 4 ? -least : least; // of half the angles: 0 or pi
}

TEST(MeshDistance, OfABoxIsItsClosedForm) {
    const Mesh box = mesh_of(box_mesh(0.1, 0.1, 0.1));
    const MeshDistance distance(box.surface, std::pmr::get_default_resource());
    const double half = double(0.1f);
    Points points;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 x = points.in_cube(0.25);
        const Vec3 beyond = x.cwiseAbs() - Vec3::Constant(half);
        const double expected = beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
        const MeshNearest nearest = distance.nearest(x);
        EXPECT_NEAR(nearest.signed_distance(), expected, 1e-12) << x.transpose();
        EXPECT_NEAR((x - nearest.point).norm(), nearest.distance, 1e-12);
        EXPECT_NEAR(nearest.point.cwiseAbs().maxCoeff(), half, 1e-12);
    }
}

TEST(MeshDistance, OfCurvedShapesIsWhatASearchOfAllTrianglesFinds) {
    for (const ShapeMesh& shape :
         {bent_tube_mesh(0.1, 0.04, 16, 24), torus_mesh(0.1, 0.03, 12, 20)}) {
        const Mesh mesh = mesh_of(shape);
        const MeshDistance distance(mesh.surface, std::pmr::get_default_resource());
        Points points;
        uint32_t hint = 0;
        int inside = 0;
        for (int i = 0; i < 1500; ++i) {
            const Vec3 x = points.in_cube(0.15);
            const MeshNearest nearest = distance.nearest(x, hint);
            hint = nearest.triangle;
            inside += nearest.inside;
            EXPECT_NEAR(nearest.signed_distance(), searched(mesh.surface, x), 1e-12);
        }
        EXPECT_GT(inside, 50);
    }
}

// Nearest to an edge or a corner of a star the plane of a face is on the wrong side.
TEST(MeshDistance, SignsHoldBesideSharpCorners) {
    ShapeMesh spike = box_mesh(0.1, 0.1, 0.1);
    spike.positions[7] = {0.5f, 0.5f, 0.5f};
    spike.positions[0] = {0.05f, 0.05f, 0.05f}; // pushed in
    const Mesh mesh = mesh_of(spike);
    const MeshDistance distance(mesh.surface, std::pmr::get_default_resource());
    Points points;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 x = points.in_cube(0.6);
        EXPECT_NEAR(distance.nearest(x).signed_distance(), searched(mesh.surface, x), 1e-12);
    }
}

struct FieldError {
    double rms, largest; // m
    double edge;
};

FieldError error_of(const Mesh& mesh, uint32_t cells) {
    const MeshField field = field_of(mesh, cells);
    const MeshDistance distance(mesh.surface, std::pmr::get_default_resource());
    Points points;
    double sum = 0, largest = 0;
    int number = 0;
    while (number < 20000) { // within 6 mm of the surface
        const auto& t =
            mesh.surface
                .triangles[static_cast<size_t>(number) * 7919 % mesh.surface.triangles.size()];
        const Vec3 share = points.in_cube(0.5) + Vec3::Constant(0.5),
                   beside = points.in_cube(0.0035);
        Vec3 x = beside;
        for (size_t k = 0; k < 3; ++k)
            x += share[static_cast<Eigen::Index>(k)] / share.sum() * corner(mesh.surface, t, k);
        ++number;
        const MeshNearest nearest = distance.nearest(x);
        const double off = sample_field(field, {x[0], x[1], x[2]}) - nearest.signed_distance();
        sum += off * off;
        largest = std::max(largest, std::abs(off));
    }
    return {std::sqrt(sum / number), largest, double(field.edge)};
}

TEST(MeshField, ErrorsFallWithTheCells) {
    const struct {
        ShapeMesh shape;
        double order; // of a closed smooth mesh; edges and creases are lost by a cell's width
    } shapes[] = {{torus_mesh(0.1, 0.04, 96, 192), 1.8},
                  {ellipsoid_mesh(0.09, 0.12, 0.1, 96, 64), 1.8},
                  {bent_tube_mesh(0.1, 0.04, 48, 96), 1.5},
                  {box_mesh(0.1, 0.1, 0.1), 1.5}};
    for (const auto& [shape, order] : shapes) {
        const Mesh mesh = mesh_of(shape);
        const FieldError coarse = error_of(mesh, 24), fine = error_of(mesh, 48);
        EXPECT_GE(std::log(coarse.rms / fine.rms) / std::log(coarse.edge / fine.edge), order);
        for (const FieldError& error : {coarse, fine})
            EXPECT_LE(error.largest, 0.7 * error.edge);
    }
}

// Beyond the band, outside, what is kept may be less than the distance, and is never more.
TEST(MeshField, NodesAreExactWhereTheyMatterAndCautiousBeyond) {
    const Mesh mesh = mesh_of(ellipsoid_mesh(0.09, 0.12, 0.1, 24, 16));
    const MeshField field = field_of(mesh, 40);
    const MeshDistance distance(mesh.surface, std::pmr::get_default_resource());
    size_t beyond = 0, less = 0;
    for (size_t z = 0; z < field.nodes[2]; ++z)
        for (size_t y = 0; y < field.nodes[1]; ++y)
            for (size_t x = 0; x < field.nodes[0]; ++x) {
                const auto at = field.place(x, y, z);
                const double d = distance.nearest({at[0], at[1], at[2]}).signed_distance();
                const double kept =
                    double(field.value[(z * field.nodes[1] + y) * field.nodes[0] + x]);
                if (d < double(field.band)) {
                    EXPECT_NEAR(kept, d, 1e-8);
                    continue;
                }
                ++beyond;
                less += kept < d - 1e-6;
                EXPECT_GE(kept, double(field.band) * (1 - 1e-6));
                EXPECT_LE(kept, d * (1 + 1e-6));
            }
    EXPECT_GT(beyond, 1000u);
    EXPECT_GT(less, beyond / 3);
}

TEST(MeshField, TheOrderOfTrianglesChangesNoBit) {
    ShapeMesh shape = bent_tube_mesh(0.1, 0.04, 16, 24);
    const MeshField first = field_of(mesh_of(shape), 32);
    std::mt19937 random(5);
    for (int run = 0; run < 3; ++run) {
        std::ranges::shuffle(shape.triangles, random);
        const MeshField other = field_of(mesh_of(shape), 32);
        ASSERT_EQ(other.nodes, first.nodes);
        EXPECT_EQ(std::memcmp(other.value.data(), first.value.data(), 4 * first.count()), 0);
    }
}

TEST(MeshField, OutsideTheGridIsFar) {
    const Mesh mesh = mesh_of(ellipsoid_mesh(0.09, 0.12, 0.1, 24, 16));
    const MeshField field = field_of(mesh, 24);
    const MeshDistance distance(mesh.surface, std::pmr::get_default_resource());
    Points points;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 x = points.in_cube(0.4);
        const double d = distance.nearest(x).signed_distance();
        const double kept = sample_field(field, {x[0], x[1], x[2]});
        EXPECT_LE(kept, d + 0.2 * double(field.edge));
        EXPECT_GE(kept, std::min(d, double(field.band)) - 0.2 * double(field.edge));
    }
}

TEST(MeshField, ASheetIsAsThickAsTwoCells) {
    const Mesh mesh = mesh_of(sheet_mesh(0.1));
    const MeshField field = field_of(mesh, 32, true);
    EXPECT_NEAR(sample_field(field, {0, 0, 0}), -double(field.edge), 0.51 * double(field.edge));
    for (const double y : {0.02, -0.02})
        EXPECT_NEAR(sample_field(field, {0.03, y, 0.01}), 0.02 - double(field.edge), 1e-6);
    EXPECT_NEAR(sample_field(field, {0.11, 0, 0}), 0.01 - double(field.edge),
                0.5 * double(field.edge));
}

TEST(MeshField, WhatHasNoInsideIsRefused) {
    MeshField field(std::pmr::get_default_resource());
    const Status open = bake_field(mesh_of(sheet_mesh(1)), {16, false}, field);
    EXPECT_EQ(open.error().code, PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(open.error().message.find("4 open edges, the first between the vertices 0 and 1"),
              std::string::npos)
        << open.error().message;
    ShapeMesh two = box_mesh(1, 1, 1), other = box_mesh(1, 1, 1);
    for (auto& p : other.positions)
        p = {p[0] + 2, p[1] + 2, p[2]};
    two.add_mesh(other); // along one edge
    Mesh touching(std::pmr::get_default_resource());
    ASSERT_TRUE(build_mesh(raw_of(two), PLAIT_REPAIR_POLICY_REPAIR, "", touching).ok());
    const Status unsided = bake_field(touching, {16, false}, field);
    EXPECT_NE(unsided.error().message.find("1 edges of more than two"), std::string::npos)
        << unsided.error().message;
    EXPECT_TRUE(bake_field(touching, {16, true}, field).ok());
}

} // namespace
} // namespace plait
