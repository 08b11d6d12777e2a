// Volume: limp hair on a ball, which without it sinks onto the ball, keeps the room of the groom and its
// height at 60 and 120 Hz, and comes to rest; and few strands, of which none may
// shoot out.
#include "api/mesh_shapes.hpp"
#include "api/support.hpp"
#include "generator/generator.hpp"

#include <algorithm>
#include <cmath>

namespace {

constexpr auto radius = static_cast<float>(plait_generator::ball_radius);

struct Use {
    plait_model model;
    int rate; // 1/s
    uint32_t strands;
    float jitter; // most, of a length a step, at the end
};

void PrintTo(const Use& use, std::ostream* out) {
    *out << use.strands << " strands of model " << use.model << " at " << use.rate << " Hz";
}

struct Room {
    double volume = 0; // m^3: M^2 over the sum of squares in cells of 12 mm
    double height = 0; // m, over the ball, of what is above its equator
};

Room room_of(const std::vector<float>& x) {
    constexpr int n = 60;
    constexpr float edge = 0.012f;
    std::vector<double> cells(n * n * n, 0.0);
    Room room;
    double all = 0, squares = 0, above = 0;
    for (size_t i = 0; i < x.size(); i += 4) {
        const auto cell = [&](size_t axis, float from) {
            return std::clamp(static_cast<int>((x[i + axis] + from) / edge), 0, n - 1);
        };
        cells[(cell(1, 0.45f) * n + cell(2, 0.36f)) * n + cell(0, 0.36f)] += 1;
        all += 1;
        if (x[i + 1] > 0) {
            room.height += double(std::hypot(x[i], x[i + 1], x[i + 2]) - radius);
            above += 1;
        }
    }
    for (const double count : cells)
        squares += count * count;
    room.volume = all * all / squares * double(edge) * double(edge) * double(edge);
    room.height /= above;
    return room;
}

plait::SimDesc limp(const Use& use, bool volume) {
    plait::SimDesc desc;
    desc.model = use.model;
    desc.step = 1.0f / static_cast<float>(use.rate);
    desc.params.drag = 1;
    desc.grid.edge = 0.6f;
    desc.grid.edge_count = 32;
    desc.grid.origin[0] = desc.grid.origin[2] = -0.3f;
    desc.grid.origin[1] = -0.39f;
    if (volume) {
        desc.grid.on = true;
        desc.volume.on = true;
    }
    return desc;
}

struct Outcome {
    double volume, height; // over those at rest
    double jitter;         // of a length a step, rms of all vertices in the last two seconds
};

// m^2, of all vertices.
double squared_ways(const std::vector<float>& from, const std::vector<float>& to) {
    double sum = 0;
    for (size_t i = 0; i < to.size(); ++i)
        if (i % 4 != 3)
            sum += std::pow(double(to[i]) - double(from[i]), 2);
    return sum;
}

enum class Body { sphere, field, nearest };

// The ball, as a sphere or as triangles.
void add_ball(plait::Sim& sim, Body body) {
    constexpr float friction = 0.2f;
    if (body == Body::sphere) {
        auto ball = smooth_collider();
        std::fill_n(ball.capsule.a, 3, 0.0f);
        std::fill_n(ball.capsule.b, 3, 0.0f);
        ball.capsule.radius_a = ball.capsule.radius_b = radius;
        ball.friction = friction;
        (void)sim.create_collider(ball);
        return;
    }
    const auto r = double(radius);
    const ShapeMesh shape = ellipsoid_mesh(r, r, r, 48, 32);
    auto given = plait_mesh_desc_defaults();
    given.positions = {shape.positions.data(), shape.positions.size(), 0};
    given.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    auto desc = plait_collider_mesh_desc_defaults();
    desc.form = body == Body::field ? PLAIT_MESH_FORM_FIELD : PLAIT_MESH_FORM_NEAREST;
    desc.friction = friction;
    (void)sim.create_collider(plait::Mesh(given), desc);
}

Outcome after(double seconds, const Use& use, bool volume, Body body = Body::sphere) {
    const plait::Context context;
    auto style = plait_generator::make_style(plait_generator::Hairstyle::Ball);
    style.strands = use.strands;
    const auto rest = make_groom(style).positions;
    auto given = plait_groom_desc_defaults();
    given.positions = plait::view(rest, 3);
    given.vertices_per_strand = style.vertices;
    plait::Sim sim(context, plait::Groom(given), limp(use, volume));
    add_ball(sim, body);
    const Room begin = room_of(sim.read(PLAIT_FIELD_POSITION));
    const int steps = static_cast<int>(seconds * use.rate), last = 2 * use.rate;
    for (int i = 0; i < steps - last; ++i)
        sim.step(1.0 / use.rate);
    double ways = 0;
    auto positions = sim.read(PLAIT_FIELD_POSITION);
    for (int i = 0; i < last; ++i) {
        const auto before = positions;
        sim.step(1.0 / use.rate);
        positions = sim.read(PLAIT_FIELD_POSITION);
        ways += squared_ways(before, positions);
    }
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    EXPECT_EQ(sim.measure().grid_outside, 0u);
    const Room end = room_of(positions);
    return {end.volume / begin.volume, end.height / begin.height,
            std::sqrt(ways / last / (double(positions.size()) / 4)) / style.length};
}

void expect_kept(const Outcome& got, const Use& use) {
    EXPECT_GE(got.volume, 0.9);
    EXPECT_LE(got.volume, 1.15);
    EXPECT_GE(got.height, 0.9);
    EXPECT_LE(got.height, 1.15);
    EXPECT_LE(got.jitter, double(use.jitter)); // 1e-4 is rest, see docs/volume.md
}

class Ball : public testing::TestWithParam<Use> {};

// Few strands have less around them to rest on.
INSTANTIATE_TEST_SUITE_P(Few, Ball,
                         testing::Values(Use{PLAIT_MODEL_ARTICULATED, 60, 2000, 1.5e-4f},
                                         Use{PLAIT_MODEL_ARTICULATED, 120, 2000, 1.5e-4f}));
// `chain` does not come to rest on the ball without volume, either.
INSTANTIATE_TEST_SUITE_P(Many, Ball,
                         testing::Values(Use{PLAIT_MODEL_ARTICULATED, 60, 10000, 1e-4f}));
INSTANTIATE_TEST_SUITE_P(Long, Ball,
                         testing::Values(Use{PLAIT_MODEL_ARTICULATED, 120, 10000, 1e-4f}));

TEST_P(Ball, keeps_its_volume_and_height_for_ten_seconds_and_rests) {
    expect_kept(after(10, GetParam(), true), GetParam());
}

// Nodes in a mesh are closed, too: else hair is pushed into it, and thrown out again.
TEST(BallOfTriangles, is_a_ball) {
    const Use use{PLAIT_MODEL_ARTICULATED, 60, 2000, 0};
    const Outcome on_sphere = after(3, use, true);
    for (const Body body : {Body::field, Body::nearest}) {
        const Outcome got = after(3, use, true, body);
        EXPECT_NEAR(got.volume, on_sphere.volume, 0.02);
        EXPECT_NEAR(got.height, on_sphere.height, 0.02);
        EXPECT_LT(got.jitter, 2 * on_sphere.jitter);
    }
}

class BareBall : public testing::TestWithParam<Use> {};

INSTANTIATE_TEST_SUITE_P(Models, BareBall,
                         testing::Values(Use{PLAIT_MODEL_ARTICULATED, 60, 500, 0},
                                         Use{PLAIT_MODEL_ARTICULATED, 120, 500, 0}));

TEST_P(BareBall, sinks_without_volume) {
    const Outcome got = after(2, GetParam(), false);
    EXPECT_LT(got.volume, 0.6);
    EXPECT_LT(got.height, 0.4);
}

constexpr float wind_speed = 3; // m/s

// On a head that shakes in wind or in still air.
struct Sparse {
    plait_model model;
    uint32_t strands;
    bool wind, mesh;
    int frames; // 1/60 s
};

void PrintTo(const Sparse& hair, std::ostream* out) {
    *out << hair.strands << " strands of model " << hair.model << (hair.wind ? ", wind" : "")
         << (hair.mesh ? ", mesh" : "");
}

// m/s, of all vertices in all frames.
double greatest_speed(const Sparse& hair, const plait::Groom& groom, bool volume) {
    plait::SimDesc desc;
    desc.model = hair.model;
    desc.grid.on = true;
    desc.grid.edge_count = 16;
    desc.volume.on = volume;
    const plait::Context context;
    plait::Sim sim(context, groom, desc);
    plait_collider_id head{};
    if (hair.mesh)
        head = sim.create_collider(plait::Mesh::load(PLAIT_SOURCE_DIR "/assets/head.obj"));
    auto wind = plait_wind_desc_defaults();
    wind.velocity[2] = -wind_speed;
    wind.turbulence = 1;
    wind.hairs_per_strand = 60;
    if (hair.wind)
        sim.set_wind(wind);
    double most = 0;
    for (int frame = 0; frame < hair.frames; ++frame) {
        const float time = float(frame) / 60, half = 0.25f * std::sin(6 * time);
        const auto roots =
            head_at({0, 0.02f * std::sin(9 * time), 0}, {0, std::sin(half), 0, std::cos(half)});
        sim.set_roots(roots);
        if (hair.mesh)
            sim.set_collider_pose(head, roots.head);
        sim.step(1.0 / 60);
        most = std::max(most, double(sim.measure().max_speed));
    }
    return most;
}

class FewStrands : public testing::TestWithParam<Sparse> {};

INSTANTIATE_TEST_SUITE_P(Models, FewStrands,
                         testing::Values(Sparse{PLAIT_MODEL_ARTICULATED, 300, true, false, 60},
                                         Sparse{PLAIT_MODEL_ARTICULATED, 300, true, true, 60},
                                         Sparse{PLAIT_MODEL_ARTICULATED, 3000, false, true, 20}));

// Voxels that a strand or two cross: hair comes and goes in them from step to step, and what their
// pressure did to it may not come back on what is left there.
TEST_P(FewStrands, do_not_shoot_out) {
    plait_mesh* loaded = nullptr;
    if (GetParam().mesh &&
        plait_mesh_load(PLAIT_SOURCE_DIR "/assets/head.obj", nullptr, &loaded) == PLAIT_UNSUPPORTED)
        GTEST_SKIP() << plait_last_error();
    plait_mesh_destroy(loaded);
    auto style = plait_generator::make_style(plait_generator::Hairstyle::Long);
    style.strands = GetParam().strands;
    style.vertices = 16;
    const auto rest = make_groom(style).positions;
    auto given = plait_groom_desc_defaults();
    given.positions = plait::view(rest, 3);
    given.vertices_per_strand = style.vertices;
    const plait::Groom groom(given);
    const double without = greatest_speed(GetParam(), groom, false);
    EXPECT_LT(greatest_speed(GetParam(), groom, true), std::max(1.5 * without, double(wind_speed)))
        << without << " m/s without";
}

} // namespace
