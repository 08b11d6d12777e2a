// Hair on a ball: where its roots and its layer are, by the closed forms that it is made from.
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace plait_generator {
namespace {

Style ball_of(uint32_t strands) {
    Style style = make_style(Hairstyle::Ball);
    style.strands = strands;
    return style;
}

TEST(Ball, has_the_strands_and_vertices_asked_for) {
    Style style = ball_of(7);
    style.vertices = 33;
    const Strands groom = make_groom(style);
    EXPECT_EQ(groom.vertex_counts, std::vector<uint32_t>(7, 33));
    EXPECT_EQ(groom.positions.size(), 3u * 7 * 33);
    EXPECT_EQ(groom.uv.size(), 2u * 7);
    EXPECT_EQ(style_problem(style), "");
    const Strands again = make_groom(style);
    EXPECT_EQ(again.positions, groom.positions);
    style.seed = 2;
    EXPECT_NE(make_groom(style).positions, groom.positions);
}

// 1 mm above the ball, and 1 - cos of the angle from the pole is the area of its map.
TEST(Ball, roots_lie_in_its_cap_in_equal_areas) {
    const Style style = ball_of(4000);
    const Strands groom = make_groom(style);
    size_t inner = 0;
    for (size_t i = 0; i < style.strands; ++i) {
        const Vec3 root = strand(groom, i)[0];
        ASSERT_NEAR(length(root), ball_radius + 0.001, 1e-7) << "strand " << i;
        const double area = 1 - root.y / length(root), all = 1 - ball_hairline / ball_radius;
        const double u = 2 * groom.uv[2 * i] - 1, v = 2 * groom.uv[2 * i + 1] - 1;
        ASSERT_NEAR(area, all * (u * u + v * v), 1e-6) << "strand " << i;
        ASSERT_LT(area, all + 1e-6);
        inner += area < all / 2;
    }
    EXPECT_NEAR(static_cast<double>(inner), 2000, 4 * std::sqrt(1000.0));
}

TEST(Ball, strands_lie_in_their_layer_and_hang_below_the_equator) {
    const Style style = ball_of(1000);
    const Strands groom = make_groom(style);
    double top = 0, sum = 0;
    for (size_t i = 0; i < style.strands; ++i) {
        const auto vertices = strand(groom, i);
        for (size_t k = 0; k < vertices.size(); ++k) {
            const Vec3 p = vertices[k];
            const double r = p.y > 0 ? length(p) : std::hypot(p.x, p.z);
            const double off = r - ball_radius - 0.001;
            const double along = style.length * static_cast<double>(k) / 15;
            const double risen = 0.03 * (1 - std::exp(-along / 0.03));
            ASSERT_GE(off, 0.05 * risen - 1e-7) << "strand " << i << ", vertex " << k;
            ASSERT_LE(off, risen + 1e-7) << "strand " << i << ", vertex " << k;
            top = std::max(top, off);
            sum += k == 10 ? off : 0;
        }
        const double root = std::acos(vertices[0].y / length(vertices[0]));
        ASSERT_NEAR(vertices[15].y, -(root + 0.25 / 0.115 - pi / 2) * 0.115, 1e-6)
            << "strand " << i;
    }
    EXPECT_GT(top, 0.0295);
    EXPECT_NEAR(sum / 1000, 0.03 * 0.525, 0.001); // drawn evenly
}

TEST(Ball, is_a_closed_sphere_that_faces_outwards) {
    const HeadMesh mesh = make_ball();
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    EXPECT_EQ(mesh.triangles.size(), 3u * 20448);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
        Vec3 corner[3];
        for (size_t k = 0; k < 3; ++k) {
            ++edges[{mesh.triangles[t + k], mesh.triangles[t + (k + 1) % 3]}];
            corner[k] = point(mesh.positions, mesh.triangles[t + k]);
            ASSERT_NEAR(length(corner[k]), ball_radius, 1e-7);
        }
        const Vec3 middle = (corner[0] + corner[1] + corner[2]) * (1 / 3.0);
        ASSERT_GT(dot(cross(corner[1] - corner[0], corner[2] - corner[0]), middle), 0);
        ASSERT_GT(length(middle), ball_radius - 5e-5);
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    ASSERT_EQ(ball_colliders().size(), 1u);
    EXPECT_EQ(ball_colliders()[0].radius_a, static_cast<float>(ball_radius));
}

} // namespace
} // namespace plait_generator
