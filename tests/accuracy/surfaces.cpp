// Contact of the model articulated with planes, boxes and hulls: what a plane at any tilt and friction's
// angle say in closed form, kinds that are each other's limits, and nothing that passes through.
#include "accuracy/one_collider.hpp"
#include "api/mesh_shapes.hpp"

#include <cstdio>
#include <utility>

namespace plait::test {
namespace {

plait_collider_id add(const OneStrand& strand, const plait_collider_desc& desc) {
    plait_collider_id id{};
    PLAIT_EXPECT(plait_collider_create(strand.sim(), &desc, &id));
    return id;
}

// That of a box about `centre`, in a frame of its own.
plait_collider_id add_hull(const OneStrand& strand, Vec3 centre, Vec3 half_extents, float margin,
                           float friction, plait_pose pose = {{0, 0, 0, 1}, {0, 0, 0}}) {
    ShapeMesh shape =
        box_mesh(double(half_extents[0]), double(half_extents[1]), double(half_extents[2]));
    for (auto& p : shape.positions)
        for (size_t k = 0; k < 3; ++k)
            p[k] += centre[k];
    plait_mesh_desc mesh_desc = plait_mesh_desc_defaults();
    mesh_desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    mesh_desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    plait_mesh* mesh = nullptr;
    PLAIT_EXPECT(plait_mesh_create(&mesh_desc, nullptr, &mesh));
    plait_collider_hull_desc desc = plait_collider_hull_desc_defaults();
    desc.margin = margin;
    desc.friction = friction;
    desc.pose = pose;
    plait_collider_id id{};
    PLAIT_EXPECT(plait_collider_create_hull(strand.sim(), mesh, &desc, &id));
    plait_mesh_destroy(mesh);
    return id;
}

void move(const OneStrand& strand, plait_collider_id id, Vec3 t) {
    const plait_pose pose = {{0.0f, 0.0f, 0.0f, 1.0f}, {t[0], t[1], t[2]}};
    PLAIT_EXPECT(plait_collider_set_pose(strand.sim(), id, &pose));
}

plait_collider_desc plane(Vec3 point, Vec3 normal, float friction) {
    plait_collider_desc desc = smooth_collider();
    desc.kind = PLAIT_COLLIDER_KIND_PLANE;
    std::copy(point.begin(), point.end(), desc.plane.point);
    std::copy(normal.begin(), normal.end(), desc.plane.normal);
    desc.friction = friction;
    return desc;
}

plait_collider_desc box(Vec3 centre, Vec3 half_extents, float rounding, float friction) {
    plait_collider_desc desc = smooth_collider();
    desc.kind = PLAIT_COLLIDER_KIND_BOX;
    std::copy(centre.begin(), centre.end(), desc.box.centre);
    std::copy(half_extents.begin(), half_extents.end(), desc.box.half_extents);
    desc.box.rounding = rounding;
    desc.friction = friction;
    return desc;
}

plait_collider_desc capsule(Vec3 a, Vec3 b, float radius, float friction) {
    plait_collider_desc desc = smooth_collider();
    std::copy(a.begin(), a.end(), desc.capsule.a);
    std::copy(b.begin(), b.end(), desc.capsule.b);
    desc.capsule.radius_a = desc.capsule.radius_b = radius;
    desc.friction = friction;
    return desc;
}

// Where a strand along x comes to, after `seconds`, with one collider.
Points rest_on(const Use& use, const plait_collider_desc& collider, double seconds) {
    OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(use));
    add(strand, collider);
    strand.run(seconds);
    return strand.read(PLAIT_FIELD_POSITION);
}

class Surfaces : public testing::TestWithParam<Use> {};

INSTANTIATE_TEST_SUITE_P(Models, Surfaces, testing::Values(Use{PLAIT_MODEL_ARTICULATED, 1}));

// The root is 1 cm above; the plane leans about an axis of its own.
TEST_P(Surfaces, hair_rests_on_a_plane_at_any_tilt) {
    for (const double degrees : {0.0, 20.0, 50.0, 80.0}) {
        const double s = std::sin(degrees * pi / 180), c = std::cos(degrees * pi / 180);
        const Vec3 n = {static_cast<float>(-0.6 * s), static_cast<float>(c),
                        static_cast<float>(0.8 * s)};
        const Vec3 point = {-0.01f * n[0], -0.01f * n[1], -0.01f * n[2]};
        const Points x = rest_on(GetParam(), plane(point, n, 0.3f), 4.0);
        double deepest = 0;
        int touching = 0;
        for (size_t i = 1; i < x.size(); ++i) {
            double above = 0;
            for (size_t k = 0; k < 3; ++k)
                above += double(n[k]) * (double(x[i][k]) - double(point[k]));
            deepest = std::max(deepest, -above);
            touching += above < 1e-4;
        }
        EXPECT_LT(deepest, 1e-4) << degrees << " degrees";
        EXPECT_GT(touching, 4) << degrees << " degrees";
    }
}

// ---- a plane under the strand that leans by more or less than friction's angle -----------------

class Slope {
  public:
    // `degrees` beyond the angle of friction. Down the slope is -z. It is a plane, or the face of a hull.
    Slope(plait_model model, float friction, double degrees, bool hull = false) {
        const double angle = std::atan(double(friction)) + degrees * pi / 180;
        plait::SimDesc desc = desc_of({model, 1});
        desc.params.drag = 0.0f;
        desc.material.bend_stiffness = 1e-10f; // hardly holds: the strand slides as one
        down_ = {0.0f, static_cast<float>(-std::sin(angle)), static_cast<float>(-std::cos(angle))};
        strand_ = std::make_unique<OneStrand>(StrandShape{17, length, {1.0f, 0.0f, 0.0f}}, desc);
        const auto half = static_cast<float>(angle / 2);
        if (hull)
            add_hull(*strand_, {0, -0.5f, 0}, {2, 0.5f, 2}, 0, friction,
                     {{-std::sin(half), 0, 0, std::cos(half)}, {0, 0, 0}});
        else
            add(*strand_, plane({5.0f, 0.0f, 0.0f}, {0.0f, -down_[2], down_[1]}, friction));
        expected_ = double(g) * (std::sin(angle) - double(friction) * std::cos(angle));
    }
    // m/s of the tip, down the slope, over a number of steps.
    double speed(int steps) {
        const double from = along();
        for (int i = 0; i < steps; ++i)
            strand_->step();
        return (along() - from) * 60 / steps;
    }
    double expected() const { return expected_; } // m/s^2

  private:
    double along() const {
        const auto tip = strand_->tip();
        return double(tip[1]) * double(down_[1]) + double(tip[2]) * double(down_[2]);
    }
    std::unique_ptr<OneStrand> strand_;
    Vec3 down_ = {};
    double expected_ = 0;
};

TEST(SlopeFriction, holds_a_degree_below_its_angle) {
    for (const bool hull : {false, true}) {
        Slope slope(PLAIT_MODEL_ARTICULATED, 0.3f, -1, hull);
        slope.speed(60);
        EXPECT_LT(slope.speed(60), 1e-3 * double(length)) << hull;
    }
}

TEST(SlopeFriction, lets_go_a_degree_above) {
    for (const bool hull : {false, true}) {
        Slope slope(PLAIT_MODEL_ARTICULATED, 0.3f, 1, hull);
        slope.speed(20);
        EXPECT_GT(slope.speed(5), 0.02) << hull;
    }
}

TEST(SlopeFriction, is_mu_times_the_push_while_it_slides) {
    Slope slope(PLAIT_MODEL_ARTICULATED, 0.3f, 10);
    slope.speed(2);
    const double before = slope.speed(1);
    slope.speed(5);
    const double after = slope.speed(1);
    EXPECT_NEAR((after - before) * 60 / 6, slope.expected(), 0.05 * slope.expected());
}

TEST_P(Surfaces, moving_plane_drags_hair_along) {
    for (const float friction : {0.0f, 1.0f}) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(GetParam()));
        const auto table = add(strand, plane({0, -0.05f, 0}, {0, 1, 0}, friction));
        strand.run(3.0);
        const Points before = strand.read(PLAIT_FIELD_POSITION);
        for (int i = 1; i <= 30; ++i) {
            move(strand, table, {0.0f, 0.0f, 0.001f * static_cast<float>(i)});
            strand.step();
        }
        const double moved = largest_move(before, strand.read(PLAIT_FIELD_POSITION));
        if (friction > 0.0f)
            EXPECT_GT(moved, 0.01);
        else
            EXPECT_LT(moved, 0.001);
    }
}

// Hair lies on the top of a block that goes aside and turns about the middle of it: by friction it goes
// along, and nothing of it is inside.
TEST_P(Surfaces, moving_hull_carries_hair) {
    for (const float friction : {0.0f, 1.0f}) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(GetParam()));
        const auto block = add_hull(strand, {0, -0.1f, 0}, {0.5f, 0.05f, 0.5f}, 0, friction);
        strand.run(3.0);
        const Points before = strand.read(PLAIT_FIELD_POSITION);
        double deepest = 0;
        for (int i = 1; i <= 30; ++i) {
            const float half = 0.002f * static_cast<float>(i);
            const plait_pose pose = {{0, std::sin(half), 0, std::cos(half)},
                                     {0, 0, 0.0005f * static_cast<float>(i)}};
            PLAIT_EXPECT(plait_collider_set_pose(strand.sim(), block, &pose));
            strand.step();
            for (const auto& x : strand.read(PLAIT_FIELD_POSITION))
                deepest = std::max(deepest, -0.05 - double(x[1]));
        }
        EXPECT_LT(deepest, 1e-3);
        const double moved = largest_move(before, strand.read(PLAIT_FIELD_POSITION));
        if (friction > 0.0f)
            EXPECT_GT(moved, 0.01);
        else
            EXPECT_LT(moved, 0.002);
    }
}

// ---- kinds that are each other's limits --------------------------------------------------------

// s: they have met. Without friction, where rounding would soon decide what sticks.
constexpr double early = 0.25;

TEST_P(Surfaces, a_box_s_face_is_a_plane) {
    const Points on_plane = rest_on(GetParam(), plane({0, -0.05f, 0}, {0, 3, 0}, 0), early);
    for (const float rounding : {0.0f, 0.25f}) {
        const plait_collider_desc face = box({0, -0.55f, 0}, {2, 0.5f - rounding, 2}, rounding, 0);
        EXPECT_LT(largest_move(rest_on(GetParam(), face, early), on_plane), 1e-4);
    }
}

TEST_P(Surfaces, a_hull_s_face_is_a_plane) {
    const Points on_plane = rest_on(GetParam(), plane({0, -0.05f, 0}, {0, 3, 0}, 0), early);
    for (const float margin : {0.0f, 0.25f}) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(GetParam()));
        add_hull(strand, {0, -0.55f, 0}, {2, 0.5f - margin, 2}, margin, 0);
        strand.run(early);
        EXPECT_LT(largest_move(strand.read(PLAIT_FIELD_POSITION), on_plane), 1e-4);
    }
}

// Over an edge, too: a margin rounds nothing, where a box's rounding does.
TEST_P(Surfaces, a_hull_s_margin_moves_its_faces) {
    const auto over_edge = [&](const auto& add_one) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(GetParam()));
        add_one(strand);
        strand.run(early);
        return strand.read(PLAIT_FIELD_POSITION);
    };
    const Points sharp = over_edge([](const OneStrand& strand) {
        add_hull(strand, {-0.05f, -0.07f, 0}, {0.16f, 0.06f, 0.3f}, 0, 0);
    });
    const Points margin = over_edge([](const OneStrand& strand) {
        add_hull(strand, {-0.05f, -0.07f, 0}, {0.13f, 0.03f, 0.27f}, 0.03f, 0);
    });
    const Points rounded = over_edge([](const OneStrand& strand) {
        add(strand, box({-0.05f, -0.07f, 0}, {0.13f, 0.03f, 0.27f}, 0.03f, 0));
    });
    const Points box_of_it = over_edge([](const OneStrand& strand) {
        add(strand, box({-0.05f, -0.07f, 0}, {0.16f, 0.06f, 0.3f}, 0, 0));
    });
    EXPECT_LT(largest_move(margin, sharp), 1e-4);
    EXPECT_LT(largest_move(box_of_it, sharp), 1e-4);
    EXPECT_GT(largest_move(margin, rounded), 1e-3);
}

TEST_P(Surfaces, a_box_without_width_is_a_capsule) {
    const Points on_capsule =
        rest_on(GetParam(), capsule({0.1f, -0.1f, -1.0f}, {0.1f, -0.1f, 1.0f}, 0.05f, 0), early);
    plait_collider_desc bar = box({0.1f, -0.1f, 0}, {1, 0, 0}, 0.05f, 0);
    bar.box.orientation[1] = bar.box.orientation[3] = std::sqrt(0.5f); // x to -z
    EXPECT_LT(largest_move(rest_on(GetParam(), bar, early), on_capsule), 1e-4);
}

TEST_P(Surfaces, a_box_without_extents_is_a_sphere) {
    const Vec3 centre = {0.12f, -0.1f, 0.002f};
    const Points on_sphere = rest_on(GetParam(), capsule(centre, centre, 0.06f, 0), early);
    EXPECT_LT(largest_move(rest_on(GetParam(), box(centre, {0, 0, 0}, 0.06f, 0), early), on_sphere),
              1e-4);
}

// ---- what must not pass ------------------------------------------------------------------------

// A slab, 1 cm thick, comes through hanging hair: one to five thicknesses a step. A vertex passes
// where its way, seen from the slab, crosses the middle plane well inside the rim.
TEST(Tunnelling, no_vertex_passes_through_a_slab) {
    constexpr float thick = 0.01f, high = 0.1f;
    std::vector<Vec3> points;
    for (int s = 0; s < 60; ++s)
        for (int i = 0; i < 17; ++i)
            points.push_back({-0.1f + 0.2f * static_cast<float>(s * 37 % 60) / 60.0f,
                              -length * static_cast<float>(i) / 16.0f,
                              -0.006f + 0.012f * static_cast<float>(s) / 60.0f});
    for (const auto& [pace, is_hull] : {std::pair(1.0f, false), std::pair(2.0f, false),
                                        std::pair(5.0f, false), std::pair(2.0f, true)}) {
        OneStrand hair(points, 17, desc_of({PLAIT_MODEL_ARTICULATED, 1}), shared_context());
        const auto slab = is_hull
                              ? add_hull(hair, {-0.2f, -0.3f, 0}, {thick / 2, high, 0.2f}, 0, 0.3f)
                              : add(hair, box({-0.2f, -0.3f, 0}, {thick / 2, high, 0.2f}, 0, 0.3f));
        int met = 0, passed = 0;
        Points before = hair.read(PLAIT_FIELD_POSITION);
        const int steps = static_cast<int>(0.25f / (pace * thick));
        for (int i = 0; i < steps; ++i) {
            const float from = -0.2f + pace * thick * static_cast<float>(i);
            const float to = from + pace * thick;
            move(hair, slab, {to + 0.2f, 0.0f, 0.0f});
            hair.step();
            const Points now = hair.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < now.size(); ++k) {
                const double a = double(before[k][0]) - double(from);
                const double b = double(now[k][0]) - double(to);
                met += a > double(thick) && std::abs(b - double(thick) / 2) < 1e-3;
                if (!(a > 0 && b < 0))
                    continue;
                const double y =
                    double(before[k][1]) + a / (a - b) * (double(now[k][1]) - double(before[k][1]));
                passed += std::abs(y + 0.3) < 0.9 * double(high);
            }
            before = now;
        }
        EXPECT_GT(met, 0) << pace << " thicknesses a step";
        EXPECT_EQ(passed, 0) << pace << " thicknesses a step";
    }
}

// A strand that lies on a table and hangs over its edge comes to rest, whole.
TEST_P(Surfaces, hair_over_a_table_s_edge_stays_whole) {
    OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc_of(GetParam()));
    const plait_collider_desc table = box({-0.05f, -0.07f, 0}, {0.13f, 0.03f, 0.3f}, 0.03f, 0.3f);
    add(strand, table);
    strand.run(4.0);
    const Points x = strand.read(PLAIT_FIELD_POSITION);
    EXPECT_LT(strand.tip()[1], -0.06f) << "does not hang";
    EXPECT_LT(strand.measure().max_stretch, 2e-3f);
    for (size_t i = 1; i < x.size(); ++i) {
        const double out[3] = {std::abs(double(x[i][0]) + 0.05) - 0.13,
                               std::abs(double(x[i][1]) + 0.07) - 0.03,
                               std::abs(double(x[i][2])) - 0.3};
        const double off =
            std::hypot(std::max(out[0], 0.0), std::max(out[1], 0.0), std::max(out[2], 0.0)) - 0.03;
        EXPECT_GT(off, -1e-4) << "vertex " << i;
    }
}

} // namespace
} // namespace plait::test
