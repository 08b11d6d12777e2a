// Contact of the model articulated with capsules: friction that holds up to its angle and no further,
// nothing that passes through, nothing that bursts. Bars and measured values: docs/models.
#include "stability/one_strand.hpp"

#include <cstdio>
#include <ostream>

namespace plait::test {
namespace {

constexpr float g = 9.81f; // m/s^2
constexpr float length = 0.3f;

plait::SimDesc desc_of(plait_model model, uint32_t substeps = 1) {
    plait::SimDesc desc;
    desc.model = model;
    desc.substeps = substeps;
    desc.params.gravity[1] = -g;
    return desc;
}

plait_collider_id add_capsule(const OneStrand& strand, Vec3 a, Vec3 b, float radius,
                              float friction) {
    plait_collider_desc desc = smooth_collider();
    std::copy(a.begin(), a.end(), desc.capsule.a);
    std::copy(b.begin(), b.end(), desc.capsule.b);
    desc.capsule.radius_a = desc.capsule.radius_b = radius;
    desc.friction = friction;
    desc.pose = {{0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
    plait_collider_id id{};
    PLAIT_EXPECT(plait_collider_create(strand.sim(), &desc, &id));
    return id;
}

void move(const OneStrand& strand, plait_collider_id id, Vec3 t) {
    const plait_pose pose = {{0.0f, 0.0f, 0.0f, 1.0f}, {t[0], t[1], t[2]}};
    PLAIT_EXPECT(plait_collider_set_pose(strand.sim(), id, &pose));
}

using Points = std::vector<std::array<float, 4>>;

double distance(const std::array<float, 4>& x, const Vec3& centre) {
    return std::hypot(double(x[0]) - double(centre[0]), double(x[1]) - double(centre[1]),
                      double(x[2]) - double(centre[2]));
}

double largest_move(const Points& a, const Points& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, distance(a[i], {b[i][0], b[i][1], b[i][2]}));
    return most;
}

// A model as it is used.
struct Use {
    plait_model model;
    uint32_t substeps;
};

void PrintTo(const Use& use, std::ostream* out) {
    *out << "model " << use.model << ", " << use.substeps << " substeps";
}

class Contact : public testing::TestWithParam<Use> {
  protected:
    plait::SimDesc desc() const {
        plait::SimDesc desc = desc_of(GetParam().model, GetParam().substeps);
        desc.params.drag = 1;
        return desc;
    }
};

INSTANTIATE_TEST_SUITE_P(Models, Contact, testing::Values(Use{PLAIT_MODEL_ARTICULATED, 1}));

// ---- an incline: gravity leans by an angle against the normal of a big cylinder under the strand --

class Incline {
  public:
    // `degrees` beyond the angle of friction.
    Incline(plait_model model, float friction, double degrees) {
        const double angle = std::atan(double(friction)) + degrees * 3.14159265 / 180;
        plait::SimDesc desc = desc_of(model);
        desc.params.drag = 0.0f;
        desc.material.bend_stiffness = 1e-10f; // hardly holds: the strand slides as one
        desc.params.gravity[1] = -g * static_cast<float>(std::cos(angle));
        desc.params.gravity[2] = -g * static_cast<float>(std::sin(angle));
        strand_ = std::make_unique<OneStrand>(StrandShape{17, length, {1.0f, 0.0f, 0.0f}}, desc);
        constexpr float radius = 10.0f;
        add_capsule(*strand_, {-1.0f, -radius, 0.0f}, {1.0f, -radius, 0.0f}, radius, friction);
        expected_ = double(g) * (std::sin(angle) - double(friction) * std::cos(angle));
    }
    // m/s of the tip, down the slope, over a number of steps.
    double speed(int steps) {
        const double from = double(strand_->tip()[2]);
        for (int i = 0; i < steps; ++i)
            strand_->step();
        return (from - double(strand_->tip()[2])) * 60 / steps;
    }
    double expected() const { return expected_; } // m/s^2

  private:
    std::unique_ptr<OneStrand> strand_;
    double expected_ = 0;
};

TEST(InclineFriction, holds_a_degree_below_its_angle) {
    Incline incline(PLAIT_MODEL_ARTICULATED, 0.3f, -1);
    incline.speed(60);
    EXPECT_LT(incline.speed(60), 1e-3 * double(length));
}

TEST(InclineFriction, lets_go_a_degree_above) {
    Incline incline(PLAIT_MODEL_ARTICULATED, 0.3f, 1);
    incline.speed(20);
    EXPECT_GT(incline.speed(5), 0.02);
}

TEST(InclineFriction, is_mu_times_the_push_while_it_slides) {
    Incline incline(PLAIT_MODEL_ARTICULATED, 0.3f, 10);
    incline.speed(2);
    const double before = incline.speed(1);
    incline.speed(5);
    const double after = incline.speed(1);
    EXPECT_NEAR((after - before) * 60 / 6, incline.expected(), 0.05 * incline.expected());
}

// ---- hair over a bar ----------------------------------------------------------------------------

// A level strand falls over a cylinder of 5 cm and comes to rest.
TEST_P(Contact, rests_on_a_bar_whole_and_still) {
    OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc());
    add_capsule(strand, {0.1f, -0.1f, -1.0f}, {0.1f, -0.1f, 1.0f}, 0.05f, 0.3f);
    strand.run(15.0);
    EXPECT_GT(strand.tip()[0], 0.12f); // on the far side
    EXPECT_LT(strand.measure().max_stretch, 2e-3f);
    Points before = strand.read(PLAIT_FIELD_POSITION);
    for (int i = 0; i < 30; ++i) {
        strand.step();
        const Points now = strand.read(PLAIT_FIELD_POSITION);
        EXPECT_LT(largest_move(now, before), 1e-4 * double(length));
        before = now;
    }
    for (const auto& x : before)
        EXPECT_GT(distance(x, {0.1f, -0.1f, x[2]}), 0.05 - 1e-4);
}

TEST_P(Contact, moving_surface_drags_hair_along) {
    for (const float friction : {0.0f, 1.0f}) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, desc());
        const auto bar =
            add_capsule(strand, {0.1f, -0.1f, -1.0f}, {0.1f, -0.1f, 1.0f}, 0.05f, friction);
        strand.run(3.0);
        for (int i = 1; i <= 30; ++i) {
            move(strand, bar, {0.0f, 0.0f, 0.001f * static_cast<float>(i)});
            strand.step();
        }
        float most = 0.0f;
        for (const auto& x : strand.read(PLAIT_FIELD_POSITION))
            most = std::max(most, x[2]);
        if (friction > 0.0f)
            EXPECT_GT(most, 0.01f);
        else
            EXPECT_LT(most, 0.001f);
    }
}

// Turned by `angle` about the direction `axis` through the point `through`.
plait_pose turned(Vec3 axis, float angle, Vec3 through) {
    const float s = std::sin(angle / 2), c = std::cos(angle);
    const float along = axis[0] * through[0] + axis[1] * through[1] + axis[2] * through[2];
    const Vec3 across = {axis[1] * through[2] - axis[2] * through[1],
                         axis[2] * through[0] - axis[0] * through[2],
                         axis[0] * through[1] - axis[1] * through[0]};
    plait_pose pose = {{axis[0] * s, axis[1] * s, axis[2] * s, std::cos(angle / 2)}, {}};
    for (size_t i = 0; i < 3; ++i)
        pose.t[i] =
            through[i] - (c * through[i] + std::sin(angle) * across[i] + (1 - c) * along * axis[i]);
    return pose;
}

// Over a bar that spins towards the root, hair is hauled up by so much as the surface moves, 25 mm,
// less what it slips. Soft hair: what is between root and bar has to buckle, and of hair as stiff as most
// that takes as much as friction has, so that a rounding decides.
TEST_P(Contact, spinning_surface_drags_hair_along) {
    plait::SimDesc soft = desc();
    soft.material.bend_stiffness = 1e-9f;
    for (const float friction : {0.0f, 1.0f}) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, soft);
        const Vec3 axis = {0.1f, -0.1f, 0.0f};
        const auto bar =
            add_capsule(strand, {0.1f, -0.1f, -1.0f}, {0.1f, -0.1f, 1.0f}, 0.05f, friction);
        strand.run(15.0);
        const auto before = strand.read(PLAIT_FIELD_POSITION);
        for (int i = 1; i <= 30; ++i) {
            const plait_pose pose =
                turned({0.0f, 0.0f, 1.0f}, 0.5f * static_cast<float>(i) / 30, axis);
            PLAIT_EXPECT(plait_collider_set_pose(strand.sim(), bar, &pose));
            strand.step();
        }
        const double moved = largest_move(before, strand.read(PLAIT_FIELD_POSITION));
        std::printf("friction %g: moved %.2g m\n", double(friction), moved);
        if (friction > 0.0f)
            EXPECT_GT(moved, 0.01);
        else
            EXPECT_LT(moved, 1e-3);
    }
}

// Hair along a skull that turns as fast as heads do, half a metre off the axis: it is carried, not
// rubbed, and the skull it grows from does not come between.
TEST_P(Contact, turning_head_does_not_stretch_its_hair) {
    double stretch[2] = {};
    for (const bool skull : {false, true}) {
        plait::SimDesc with = desc();
        with.params.gravity[1] = 0;
        std::vector<Vec3> points(17);
        for (size_t i = 0; i < points.size(); ++i)
            points[i] = {0.60001f, 0.0004f * static_cast<float>(i), 0.0f};
        OneStrand strand(points, with);
        plait_collider_id ball{};
        if (skull)
            ball = add_capsule(strand, {0.5f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, 0.1f, 0.5f);
        for (int i = 1; i <= 60; ++i) {
            plait_roots roots = plait_roots_defaults();
            roots.head =
                turned({0.0f, 1.0f, 0.0f}, 0.5f * std::sin(0.15f * static_cast<float>(i)), {});
            PLAIT_EXPECT(plait_sim_set_roots(strand.sim(), &roots));
            if (skull) {
                PLAIT_EXPECT(plait_collider_set_pose(strand.sim(), ball, &roots.head));
            }
            strand.step();
            stretch[skull] = std::max(stretch[skull], double(strand.measure().max_stretch));
        }
    }
    std::printf("stretch %.2g, with the skull %.2g\n", stretch[0], stretch[1]);
    EXPECT_LT(stretch[1], stretch[0] + 1e-2);
}

// A neck that rolls over the roots at the nape, 30 mm deep: no hair of 48 mm can come out of it
// there, and none is torn out.
TEST_P(Contact, surface_over_the_root_does_not_stretch_hair) {
    OneStrand strand({9, 0.048f, {0.6f, 0.8f, 0.0f}}, desc());
    const Vec3 centre = {0.0f, -0.1f, 0.0f};
    const auto ball = add_capsule(strand, centre, centre, 0.05f, 0.3f);
    double stretch = 0;
    for (int i = 1; i <= 90; ++i) {
        move(strand, ball, {0.0f, 0.002f * static_cast<float>(std::min(i, 40)), 0.0f});
        strand.step();
        stretch = std::max(stretch, double(strand.measure().max_stretch));
    }
    std::printf("stretch %.2g\n", stretch);
    EXPECT_LT(stretch, 0.01);
    EXPECT_EQ(strand.measure().nonfinite, 0u);
}

// ---- what must not pass, and not burst ----------------------------------------------------------

// A ball of 5 mm flies through hanging hair: steps of one to five radii. A vertex passes if it
// comes nearer to the centre than three quarters of the radius, seen from the ball.
TEST(Tunnelling, no_vertex_passes_through_a_ball) {
    constexpr float radius = 0.005f;
    std::vector<Vec3> points;
    for (int s = 0; s < 60; ++s)
        for (int i = 0; i < 17; ++i)
            points.push_back({-0.1f + 0.2f * static_cast<float>(s * 37 % 60) / 60.0f,
                              -length * static_cast<float>(i) / 16.0f,
                              -0.006f + 0.012f * static_cast<float>(s) / 60.0f});
    for (const float radii : {1.0f, 2.0f, 5.0f}) {
        OneStrand hair(points, 17, desc_of(PLAIT_MODEL_ARTICULATED), shared_context());
        const auto ball =
            add_capsule(hair, {-0.2f, -0.26f, 0.0f}, {-0.2f, -0.26f, 0.0f}, radius, 0.3f);
        int met = 0, passed = 0;
        Points before = hair.read(PLAIT_FIELD_POSITION);
        const int steps = static_cast<int>(0.4f / (radii * radius));
        for (int i = 0; i < steps; ++i) {
            const float from = -0.2f + radii * radius * static_cast<float>(i);
            const float to = from + radii * radius;
            move(hair, ball, {to + 0.2f, 0.0f, 0.0f});
            hair.step();
            const Points now = hair.read(PLAIT_FIELD_POSITION);
            for (size_t k = 0; k < now.size(); ++k) {
                // the way of the vertex, seen from the ball
                const double a[3] = {double(before[k][0]) - double(from),
                                     double(before[k][1]) + 0.26, double(before[k][2])};
                const double b[3] = {double(now[k][0]) - double(to), double(now[k][1]) + 0.26,
                                     double(now[k][2])};
                double square = 0, along = 0, nearest = 0;
                for (int c = 0; c < 3; ++c) {
                    square += (b[c] - a[c]) * (b[c] - a[c]);
                    along -= a[c] * (b[c] - a[c]);
                }
                const double t = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
                for (int c = 0; c < 3; ++c)
                    nearest += std::pow(a[c] + t * (b[c] - a[c]), 2);
                nearest = std::sqrt(nearest);
                if (std::hypot(a[0], a[1], a[2]) < 0.9 * double(radius))
                    continue; // it did not come from outside
                met += nearest < 1.02 * double(radius);
                passed += nearest < 0.75 * double(radius);
            }
            before = now;
        }
        EXPECT_GT(met, 0) << radii << " radii a step";
        EXPECT_EQ(passed, 0) << radii << " radii a step";
    }
}

// A hanging strand whose lower part, or all of it, starts inside a ball.
TEST_P(Contact, what_starts_inside_does_not_burst) {
    for (const float friction : {0.3f, 10.0f})
        for (const float share : {0.1f, 0.3f, 0.5f, 0.7f, 1.0f}) {
            OneStrand strand({17, length, {0.0f, -1.0f, 0.0f}}, desc());
            const Vec3 centre = {0.003f, -length * (1.0f - share / 2.0f), 0.0f};
            add_capsule(strand, centre, centre, length / 2.0f * share + 0.01f, friction);
            float stretch = 0.0f, speed = 0.0f;
            for (int i = 0; i < 300; ++i) {
                strand.step();
                const plait_sim_measures stats = strand.measure();
                ASSERT_EQ(stats.nonfinite, 0u);
                stretch = std::max(stretch, stats.max_stretch);
                speed = std::max(speed, stats.max_speed);
            }
            EXPECT_LT(stretch, 0.2f) << share << " inside, friction " << friction;
            EXPECT_LT(speed, 15.0f) << share << " inside, friction " << friction;
        }
}

} // namespace
} // namespace plait::test
