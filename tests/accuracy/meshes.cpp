// Contact of the model articulated with meshes: a ball of triangles is a ball, a face is a plane whose
// friction lets go at its angle, and nothing passes through what is thin.
#include "accuracy/one_collider.hpp"
#include "api/mesh_shapes.hpp"

#include <memory>

namespace plait::test {
namespace {

plait_collider_id add(const OneStrand& strand, const ShapeMesh& shape,
                      const plait_collider_mesh_desc& desc) {
    auto given = plait_mesh_desc_defaults();
    given.positions = {shape.positions.data(), shape.positions.size(), 0};
    given.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    plait_mesh* mesh = nullptr;
    PLAIT_EXPECT(plait_mesh_create(&given, nullptr, &mesh));
    plait_collider_id id{};
    PLAIT_EXPECT(plait_collider_create_mesh(strand.sim(), mesh, &desc, &id));
    plait_mesh_destroy(mesh);
    return id;
}

constexpr plait_mesh_form forms[] = {PLAIT_MESH_FORM_FIELD, PLAIT_MESH_FORM_NEAREST};

plait_collider_mesh_desc mesh_at(Vec3 t, float friction, uint32_t cells, plait_mesh_form form) {
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = form;
    std::copy(t.begin(), t.end(), desc.pose.t);
    desc.friction = friction;
    desc.cells = cells;
    desc.margin = 0;
    return desc;
}

class Meshes : public testing::TestWithParam<Use> {};

INSTANTIATE_TEST_SUITE_P(Models, Meshes, testing::Values(Use{PLAIT_MODEL_ARTICULATED, 1}));

// A round bar along z of 2,000 triangles.
ShapeMesh bar_mesh(double radius, double half) {
    constexpr uint32_t around = 128, along = 8;
    ShapeMesh bar = revolved_mesh(around, along, false, [=](double u, double v) {
        return std::array<double, 3>{radius * std::cos(full_turn * u),
                                     radius * std::sin(full_turn * u), half * (2 * v - 1)};
    });
    const uint32_t back = bar.add(0, 0, -half), front = bar.add(0, 0, half);
    for (uint32_t u = 0; u < around; ++u) {
        bar.triangles.push_back({back, (u + 1) % around, u});
        bar.triangles.push_back({front, along * around + u, along * around + (u + 1) % around});
    }
    return bar;
}

// A strand comes to rest over a round bar, and over a capsule as long: without friction there is one
// rest. On a ball there is none, and with friction one for each way there.
TEST_P(Meshes, a_round_bar_is_a_capsule) {
    const Vec3 middle = {0.12f, -0.1f, 0.0f};
    plait::SimDesc damped = desc_of(GetParam());
    damped.params.drag = 10;
    const auto fallen = [&](bool mesh, plait_mesh_form form = PLAIT_MESH_FORM_FIELD) {
        OneStrand strand({17, length, {1.0f, 0.0f, 0.0f}}, damped);
        if (mesh) {
            add(strand, bar_mesh(0.06, 0.1), mesh_at(middle, 0, 96, form));
        } else {
            auto desc = smooth_collider();
            desc.capsule.a[2] = -0.1f;
            desc.capsule.b[2] = 0.1f;
            desc.capsule.radius_a = desc.capsule.radius_b = 0.06f;
            std::copy(middle.begin(), middle.end(), desc.pose.t);
            plait_collider_id id{};
            PLAIT_EXPECT(plait_collider_create(strand.sim(), &desc, &id));
        }
        strand.run(4.0);
        return strand.read(PLAIT_FIELD_POSITION);
    };
    const auto over_capsule = fallen(false);
    for (const plait_mesh_form form : forms)
        EXPECT_LT(largest_move(fallen(true, form), over_capsule) / double(length), 0.002)
            << "form " << form;
}

// ---- a face under the strand that leans by more or less than friction's angle ------------------

class Slope {
  public:
    // `degrees` beyond the angle of friction. Down the slope is -z.
    Slope(plait_model model, float friction, double degrees, plait_mesh_form form) {
        const double angle = std::atan(double(friction)) + degrees * pi / 180;
        plait::SimDesc desc = desc_of({model, 1});
        desc.params.drag = 0.0f;
        desc.material.bend_stiffness = 1e-10f; // hardly holds: the strand slides as one
        down_ = {0.0f, static_cast<float>(-std::sin(angle)), static_cast<float>(-std::cos(angle))};
        strand_ = std::make_unique<OneStrand>(StrandShape{17, length, {1.0f, 0.0f, 0.0f}}, desc);
        const Vec3 normal = {0.0f, -down_[2], down_[1]};
        auto board = mesh_at({0.15f, -0.05f * normal[1], -0.05f * normal[2]}, friction, 48, form);
        board.pose.q[0] = static_cast<float>(-std::sin(angle / 2)); // about x
        board.pose.q[3] = static_cast<float>(std::cos(angle / 2));
        add(*strand_, box_mesh(0.4, 0.05, 0.4), board);
    }
    // m/s of the tip, down the slope, over a number of steps.
    double speed(int steps) {
        const double from = along();
        for (int i = 0; i < steps; ++i)
            strand_->step();
        return (along() - from) * 60 / steps;
    }

  private:
    double along() const {
        const auto tip = strand_->tip();
        return double(tip[1]) * double(down_[1]) + double(tip[2]) * double(down_[2]);
    }
    std::unique_ptr<OneStrand> strand_;
    Vec3 down_ = {};
};

TEST(MeshSlope, holds_a_degree_below_the_angle_of_friction) {
    for (const plait_mesh_form form : forms) {
        Slope slope(PLAIT_MODEL_ARTICULATED, 0.3f, -1, form);
        slope.speed(60);
        EXPECT_LT(slope.speed(60), 1e-3 * double(length)) << "form " << form;
    }
}

TEST(MeshSlope, lets_go_a_degree_above) {
    for (const plait_mesh_form form : forms) {
        Slope slope(PLAIT_MODEL_ARTICULATED, 0.3f, 1, form);
        slope.speed(20);
        EXPECT_GT(slope.speed(5), 0.02) << "form " << form;
    }
}

// ---- what must not pass ------------------------------------------------------------------------

// What comes through hanging hair, along x.
plait_collider_id add_comer(const OneStrand& hair, bool two_sided, plait_mesh_form form) {
    auto desc = mesh_at({-0.2f, -0.3f, 0.0f}, 0.3f, 128, form);
    if (form == PLAIT_MESH_FORM_NEAREST)
        desc.margin = 1e-3f; // of a sheet all there is
    if (!two_sided)
        return add(hair, box_mesh(0.005, 0.1, 0.2), desc);
    desc.two_sided = 1;
    ShapeMesh sheet;
    sheet.add_quad(sheet.add(0, -0.1, -0.2), sheet.add(0, 0.1, -0.2), sheet.add(0, 0.1, 0.2),
                   sheet.add(0, -0.1, 0.2));
    return add(hair, sheet, desc);
}

// Vertices that pass through its middle plane well inside its rim. `pace`: m a step.
int passed_through(bool two_sided, plait_model model, float pace, plait_mesh_form form) {
    constexpr double thick = 0.012, high = 0.1;
    std::vector<Vec3> points;
    for (int s = 0; s < 60; ++s)
        for (int i = 0; i < 17; ++i)
            points.push_back({-0.1f + 0.2f * static_cast<float>(s * 37 % 60) / 60.0f,
                              -length * static_cast<float>(i) / 16.0f,
                              -0.006f + 0.012f * static_cast<float>(s) / 60.0f});
    OneStrand hair(points, 17, desc_of({model, 1}), shared_context());
    const auto id = add_comer(hair, two_sided, form);
    int met = 0, passed = 0;
    Points before = hair.read(PLAIT_FIELD_POSITION);
    const int steps = static_cast<int>(0.25f / pace);
    for (int i = 0; i < steps; ++i) {
        const float from = -0.2f + pace * static_cast<float>(i), to = from + pace;
        const plait_pose pose = {{0.0f, 0.0f, 0.0f, 1.0f}, {to, -0.3f, 0.0f}};
        PLAIT_EXPECT(plait_collider_set_pose(hair.sim(), id, &pose));
        hair.step();
        const Points now = hair.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < now.size(); ++k) {
            const double a = double(before[k][0]) - double(from);
            const double b = double(now[k][0]) - double(to);
            met += a > thick && b < thick && b > 0;
            if (!(a > 0 && b < 0))
                continue;
            const double y =
                double(before[k][1]) + a / (a - b) * (double(now[k][1]) - double(before[k][1]));
            passed += std::abs(y + 0.3) < 0.9 * high;
        }
        before = now;
    }
    EXPECT_GT(met, 0) << "model " << model << ", " << double(pace) << " m a step";
    return passed;
}

// A slab of a centimetre, and a sheet of two triangles, at half to five segments a step. At more than
// two `articulated` cannot follow its contacts, with a box either.
TEST(MeshTunnelling, no_vertex_passes_through_what_is_thin) {
    for (const bool two_sided : {false, true})
        for (const plait_model model : {PLAIT_MODEL_ARTICULATED})
            for (const float segments : {0.5f, 1.0f, 2.0f, 5.0f}) {
                if (model == PLAIT_MODEL_ARTICULATED && segments > 2)
                    continue;
                for (const plait_mesh_form form : forms)
                    EXPECT_EQ(passed_through(two_sided, model, segments * length / 16, form), 0)
                        << (two_sided ? "sheet" : "slab") << ", model " << model << ", "
                        << double(segments) << " segments a step, form " << form;
            }
}

} // namespace
} // namespace plait::test
