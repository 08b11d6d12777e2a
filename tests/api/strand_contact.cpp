// Strand against strand: what holds and what slides by friction, in closed forms; what lies on what;
// what is dropped, refused, repeated; and what it costs where it is off.
#include "support.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace {

constexpr float radius = 0.002f;
constexpr size_t vertices = 16;

plait::SimDesc meeting() {
    plait::SimDesc desc;
    desc.strand_contact.on = true;
    desc.strand_contact.radius = radius;
    return desc;
}

Strand line(Point from, Point way, float spacing, size_t count = vertices) {
    Strand strand;
    for (size_t i = 0; i < count; ++i) {
        const float along = spacing * static_cast<float>(i);
        strand.push_back(
            {from[0] + along * way[0], from[1] + along * way[1], from[2] + along * way[2]});
    }
    return strand;
}

plait_pin hold(uint32_t strand, uint32_t vertex) {
    return {strand, vertex, PLAIT_PIN_FRAME_REST, {0, 0, 0}, PLAIT_PIN_HELD};
}

// ---- distances, in float64 -----------------------------------------------------------------------

using Vector = std::array<double, 3>;

Vector at(const std::vector<float>& positions, size_t vertex) {
    return {double(positions[4 * vertex]), double(positions[4 * vertex + 1]),
            double(positions[4 * vertex + 2])};
}

Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Of a point and a segment.
double distance(const Vector& p, const Vector& from, const Vector& to) {
    const Vector way = minus(to, from), out = minus(p, from);
    const double t = std::clamp(dot(way, out) / dot(way, way), 0.0, 1.0);
    const Vector off{out[0] - t * way[0], out[1] - t * way[1], out[2] - t * way[2]};
    return std::sqrt(dot(off, off));
}

// Of two segments: where both cross, seen along their common normal, or at an end of one.
double distance(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    double least =
        std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
    const Vector u = minus(b, a), v = minus(d, c), w = minus(a, c);
    const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), determinant = uu * vv - uv * uv;
    const double s = (uv * dot(v, w) - vv * dot(u, w)) / determinant;
    const double t = (uu * dot(v, w) - uv * dot(u, w)) / determinant;
    if (determinant > 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1) {
        const Vector off{w[0] + s * u[0] - t * v[0], w[1] + s * u[1] - t * v[1],
                         w[2] + s * u[2] - t * v[2]};
        least = std::min(least, std::sqrt(dot(off, off)));
    }
    return least;
}

// Of two strands of a sim, over the diameter.
double distance(const std::vector<float>& positions, size_t one, size_t other) {
    double least = std::numeric_limits<double>::max();
    for (size_t i = 0; i + 1 < vertices; ++i)
        for (size_t j = 0; j + 1 < vertices; ++j) {
            const size_t a = one * vertices + i, b = other * vertices + j;
            least = std::min(least, distance(at(positions, a), at(positions, a + 1),
                                             at(positions, b), at(positions, b + 1)));
        }
    return least / double(2 * radius);
}

// Where two strands cross, seen along z: 1 where `one` is above, -1 below, 0: they do not.
int above(const std::vector<float>& positions, size_t one, size_t other) {
    for (size_t i = 0; i + 1 < vertices; ++i)
        for (size_t j = 0; j + 1 < vertices; ++j) {
            const Vector a = at(positions, one * vertices + i),
                         c = at(positions, other * vertices + j);
            const Vector u = minus(at(positions, one * vertices + i + 1), a),
                         v = minus(at(positions, other * vertices + j + 1), c), w = minus(c, a);
            const double determinant = u[0] * v[1] - u[1] * v[0];
            const double s = (w[0] * v[1] - w[1] * v[0]) / determinant;
            const double t = (w[0] * u[1] - w[1] * u[0]) / determinant;
            if (determinant != 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1)
                return a[2] + s * u[2] > c[2] + t * v[2] ? 1 : -1;
        }
    return 0;
}

class StrandContact : public OnBackend {};
ON_EVERY_BACKEND(StrandContact);

// ---- friction --------------------------------------------------------------------------------------

// A hair that hangs along x, and across it at its middle one along y that is pinned everywhere. A pull
// of 2 m/s^2 presses the one on the other, `degrees` off the normal: the same lever bears both parts
// of it, so that the hair slides along the other where tan(degrees) exceeds friction, whatever its
// weight and stiffness.
plait::Sim pressed(const plait::Context& context, double degrees, float friction_scale = 1) {
    auto desc = meeting();
    const std::vector<uint32_t> of{0, 1};
    std::vector<plait_material> materials(2, desc.material);
    materials[1].friction_scale = friction_scale;
    if (friction_scale != 1) {
        desc.materials = materials.data();
        desc.material_count = 2;
        desc.strand_material = plait::view(of);
    }
    const double angle = degrees * std::numbers::pi / 180;
    desc.params.drag = 5;
    desc.params.gravity[0] = 9.81f;
    desc.params.gravity[1] = static_cast<float>(2 * std::sin(angle));
    desc.params.gravity[2] = static_cast<float>(-2 * std::cos(angle));
    const Strands hair{line({0.1f, -0.1f, 0}, {0, 1, 0}, 0.2f / 15),
                       line({0, 0.005f, 2 * radius}, {1, 0, 0}, 0.0125f)};
    plait::Sim sim(context, make_groom(hair), desc);
    std::vector<plait_pin> pins;
    for (uint32_t i = 1; i < vertices; ++i)
        pins.push_back(hold(0, i));
    sim.set_pins(pins);
    return sim;
}

// m: by how much the hair has gone aside where it lies on the other.
float gone_aside(const plait::Sim& sim) {
    return sim.read(PLAIT_FIELD_POSITION)[4 * (vertices + 8) + 1] - 0.005f;
}

// tan(16.7 degrees) is friction. Held hair creeps by 5e-4 of its length a second (ADR 14): 0.1 mm/s.
TEST_P(StrandContact, HairSlidesOverHairWhereItIsSteeperThanFriction) {
    plait::Sim flat = pressed(context, 8), below = pressed(context, 14.7),
               above = pressed(context, 18.7), steep = pressed(context, 30);
    for (plait::Sim* sim : {&flat, &below, &above, &steep})
        run(*sim, 60);
    EXPECT_LT(std::abs(gone_aside(flat)), 3e-4f);
    EXPECT_LT(std::abs(gone_aside(below)), 3.5e-4f);
    EXPECT_GT(gone_aside(above), 5e-4f);
    EXPECT_GT(gone_aside(above), 2 * gone_aside(below));
    EXPECT_GT(gone_aside(steep), 3e-3f);
    EXPECT_GT(distance(flat.read(PLAIT_FIELD_POSITION), 0, 1), 0.95);
    run(below, 120);
    EXPECT_LT(std::abs(gone_aside(below)), 7e-4f) << ": creeps";
    EXPECT_GT(distance(below.read(PLAIT_FIELD_POSITION), 0, 1), 0.95);
}

// By its own scale, that of the hair it lies on being 1: of 0.5 it holds up to 8.5 degrees, of 2 up to
// 31.
TEST_P(StrandContact, HairFeelsFrictionByTheScaleOfItsMaterial) {
    plait::Sim slides = pressed(context, 14.7, 0.5f), holds = pressed(context, 25, 2);
    for (plait::Sim* sim : {&slides, &holds})
        run(*sim, 60);
    EXPECT_GT(gone_aside(slides), 1e-3f);
    EXPECT_LT(std::abs(gone_aside(holds)), 5e-4f);
}

// ---- what lies on what -----------------------------------------------------------------------------

constexpr size_t per_layer = 6;

// Layers of hair, every other one along x, the others along y, on a table.
plait::Sim piled(const plait::Context& context, size_t layers) {
    auto desc = meeting();
    desc.substeps = 4;
    desc.params.gravity[1] = 0;
    desc.params.gravity[2] = -9.81f;
    Strands hair;
    for (size_t layer = 0; layer < layers; ++layer)
        for (size_t k = 0; k < per_layer; ++k) {
            const float aside = 0.02f + 0.018f * static_cast<float>(k);
            const float height = 0.0025f + 0.0044f * static_cast<float>(layer);
            hair.push_back(layer % 2 ? line({aside, 0, height}, {0, 1, 0}, 0.01f)
                                     : line({0, aside, height}, {1, 0, 0}, 0.01f));
        }
    plait::Sim sim(context, make_groom(hair), desc);
    auto table = smooth_collider();
    table.kind = PLAIT_COLLIDER_KIND_PLANE;
    std::copy_n(Point{0, 0, 1}.begin(), 3, table.plane.normal);
    table.friction = 0.3f;
    (void)sim.create_collider(table);
    return sim;
}

bool cross(size_t a, size_t b) {
    return a / per_layer % 2 != b / per_layer % 2;
}

// Of all that cross in so many layers.
double least_distance(const std::vector<float>& positions, size_t layers) {
    double least = std::numeric_limits<double>::max();
    for (size_t a = 0; a < layers * per_layer; ++a)
        for (size_t b = a + 1; b < layers * per_layer; ++b)
            if (cross(a, b))
                least = std::min(least, distance(positions, a, b));
    return least;
}

// In every frame: as it falls together hair is pressed to less than half of its diameter for one.
TEST_P(StrandContact, APileOfThreeLayersHolds) {
    plait::Sim sim = piled(context, 3);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    const int seconds = GetParam() == "reference" ? 1 : 5; // that takes half a minute for five
    for (int i = 0; i < 60 * seconds; ++i) {
        run(sim, 1);
        EXPECT_LT(sim.measure().max_stretch, 0.02f);
        EXPECT_GT(least_distance(sim.read(PLAIT_FIELD_POSITION), 3), 0.25);
    }
    const auto after = sim.read(PLAIT_FIELD_POSITION);
    size_t crossings = 0;
    for (size_t a = 0; a < 3 * per_layer; ++a)
        for (size_t b = a + 1; b < 3 * per_layer; ++b) {
            const int was = above(before, a, b);
            if (!cross(a, b) || was == 0)
                continue;
            EXPECT_EQ(above(after, a, b), was) << ": strands " << a << " and " << b;
            EXPECT_GT(distance(after, a, b), 0.6);
            ++crossings;
        }
    EXPECT_EQ(crossings, 2 * per_layer * per_layer);
}

// Between hair that is pinned at both ends and a hair that swings at it, before it falls back.
struct Swing {
    bool passed;
    double least; // distance over diameter
};

Swing swing(const plait::Context& context, float segments_a_step) {
    auto desc = meeting();
    desc.substeps = 4;
    desc.params.gravity[1] = 0;
    desc.params.drag = 0;
    constexpr float spacing = 0.0125f;
    const Strands hair{line({0.1f, -0.1f, 0}, {0, 1, 0}, 0.2f / 15),
                       line({0, 0.003f, 0.03f}, {1, 0, 0}, spacing)};
    plait::Sim sim(context, make_groom(hair), desc);
    sim.set_pins({hold(0, vertices - 1)});
    auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    for (size_t i = 1; i < vertices; ++i) // that of vertex 8, over the other, and in proportion
        velocity[4 * (vertices + i) + 2] =
            -segments_a_step * spacing * 60 * static_cast<float>(i) / 8;
    sim.write(PLAIT_FIELD_VELOCITY, velocity);
    Swing result{false, std::numeric_limits<double>::max()};
    for (int k = 0; k < 30; ++k) {
        run(sim, 1);
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        result.passed = result.passed || above(positions, 0, 1) > 0;
        result.least = std::min(result.least, distance(positions, 0, 1));
    }
    return result;
}

// A segment length a step, 0.75 m/s. At several of them a strand passes: pairs are looked for once per
// fixed step, as far as half a segment, and either strand gives way by half.
TEST_P(StrandContact, HairThatSwingsAtTautHairByASegmentAStepDoesNotPass) {
    const Swing slow = swing(context, 0.25f), fast = swing(context, 1);
    EXPECT_FALSE(slow.passed);
    EXPECT_GT(slow.least, 0.95);
    EXPECT_FALSE(fast.passed);
    EXPECT_GT(fast.least, 0.85);
    EXPECT_TRUE(swing(context, 4).passed) << ": the limit is gone, say so";
}

// Two limp hairs swing at each other, one at rest: what one loses the other has, but for what their
// roots take.
TEST_P(StrandContact, CollidingHairsShareTheirMomentum) {
    auto desc = meeting();
    desc.step = 1.0f / 240;
    desc.params.gravity[1] = 0;
    desc.params.drag = 0;
    desc.material.bend_stiffness = 0;
    desc.strand_contact.friction = 0;
    const Strands hair{line({0, -0.02f, -0.015f}, {0.99f, 0.141f, 0}, 0.01f),
                       line({0, 0.02f, 0.015f}, {0.99f, -0.141f, 0}, 0.01f)};
    // momentum along z of each, in masses of a vertex
    const auto momentum = [](const plait::Sim& sim, size_t strand) {
        const auto v = sim.read(PLAIT_FIELD_VELOCITY);
        float sum = 0;
        for (size_t i = 1; i < vertices; ++i)
            sum += (i + 1 == vertices ? 0.5f : 1.0f) * v[4 * (strand * vertices + i) + 2];
        return sum;
    };
    auto alone = desc;
    alone.strand_contact.on = false;
    plait::Sim sim(context, make_groom(hair), desc), free(context, make_groom(hair), alone);
    for (plait::Sim* each : {&sim, &free}) {
        auto v = each->read(PLAIT_FIELD_VELOCITY);
        for (size_t i = 1; i < vertices; ++i)
            v[4 * i + 2] = static_cast<float>(i) / float(vertices - 1);
        each->write(PLAIT_FIELD_VELOCITY, v);
        for (int k = 0; k < 17; ++k)
            each->step(1.0 / 240);
    }
    const float one = momentum(sim, 0), other = momentum(sim, 1);
    const float whole = momentum(free, 0) + momentum(free, 1);
    EXPECT_GT(other, 0.1f * whole);
    EXPECT_NEAR(one + other, whole, 0.1f * whole);
}

// Hair that fills a room, two diameters apart, under a head that shakes: each strand touches many at
// once, and must not gain from one what it does not lose to another.
TEST(StrandContactOnOpenCL, DenseHairOnAShakingHeadStaysSlow) {
    const auto context = make_context("opencl");
    Strands hair;
    for (size_t i = 0; i < 100; ++i)
        hair.push_back(
            line({0.004f * static_cast<float>(i % 10), 0, 0.004f * static_cast<float>(i / 10)},
                 {0.1f, -0.99f, 0.1f}, 0.02f));
    // m/s, and over the length
    const auto shaken = [&](const plait::SimDesc& desc) {
        plait::Sim sim(context, make_groom(hair), desc);
        std::pair<float, float> most;
        for (int i = 0; i < 180; ++i) {
            const float t = static_cast<float>(i) / 60, half = 0.25f * std::sin(6 * t);
            sim.set_roots(
                head_at({0.05f * std::sin(9 * t), 0, 0}, {0, std::sin(half), 0, std::cos(half)}));
            sim.step(frame);
            const auto stats = sim.measure();
            most = {std::max(most.first, stats.max_speed),
                    std::max(most.second, stats.max_stretch)};
        }
        return most;
    };
    for (const uint32_t substeps : {1u, 2u, 4u}) {
        auto desc = meeting();
        desc.substeps = substeps;
        const auto [speed, stretch] = shaken(desc);
        desc.strand_contact.on = false;
        EXPECT_LT(speed, 2.2f * shaken(desc).first) << "" << substeps << " substeps";
        EXPECT_LT(stretch, 0.05f) << "" << substeps << " substeps";
    }
}

// m: of the deepest vertex of hair of 20 cm on a ball of 9 cm with a margin of a millimetre, which is shaken by
// 5 cm at 1.7 Hz.
double deepest_in_a_shaken_ball(const plait::Context& context, size_t strands, uint32_t substeps) {
    auto desc = meeting();
    desc.substeps = substeps;
    Strands hair;
    for (size_t i = 0; i < strands; ++i) {
        const float height =
            1 - 1.1f * (static_cast<float>(i) + 0.5f) / static_cast<float>(strands);
        const float around = 2.39996f * static_cast<float>(i), r = std::sqrt(1 - height * height);
        const Point out{r * std::cos(around), height, r * std::sin(around)};
        hair.push_back(
            line({0.09f * out[0], 0.09f * out[1], 0.09f * out[2]}, out, 0.2f / (vertices - 1)));
    }
    plait::Sim sim(context, make_groom(hair), desc);
    auto ball = plait_collider_desc_defaults();
    ball.capsule.radius_a = ball.capsule.radius_b = 0.091f;
    const plait_collider_id id = sim.create_collider(ball);
    double deepest = -1;
    for (int i = 1; i <= 180; ++i) {
        const float t = static_cast<float>(i) / 60;
        const auto roots = head_at({0.05f * std::min(t, 1.0f) * std::sin(10.68f * t), 0, 0});
        sim.set_roots(roots);
        sim.set_collider_pose(id, roots.head);
        sim.step(frame);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < x.size() / 4; ++k)
            if (k % vertices != 0)
                deepest = std::max(deepest,
                                   0.09 - std::hypot(double(x[4 * k] - roots.head.t[0]),
                                                     double(x[4 * k + 1]), double(x[4 * k + 2])));
    }
    return deepest;
}

TEST_P(StrandContact, HairThatMeetsHairIsNotPushedIntoTheHead) {
    for (const uint32_t substeps : {1u, 2u}) {
        const double deepest =
            deepest_in_a_shaken_ball(context, GetParam() == "reference" ? 24 : 240, substeps);
        EXPECT_LT(deepest, 1e-3) << substeps << " substeps";
        RecordProperty("deepest_um_" + std::to_string(substeps), std::to_string(deepest * 1e6));
    }
}

// ---- who meets whom ----------------------------------------------------------------------------------

// Strands that are nearer than a diameter in the groom, and that nothing pulls at: they would be
// pushed apart by millimetres, and are moved by the rounding of their gap.
TEST_P(StrandContact, RestIsNotPushed) {
    auto desc = meeting();
    desc.params.gravity[1] = 0;
    plait::Sim sim(context,
                   make_groom({line({0, 0, 0}, {1, 0, 0}, 0.01f),
                               line({0.05f, -0.05f, 0.001f}, {0, 1, 0}, 0.01f)}),
                   desc);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    run(sim, 30);
    EXPECT_LT(largest_difference(before, sim.read(PLAIT_FIELD_POSITION)), 3e-5f);
}

Strands crowd() {
    Strands hair;
    for (size_t i = 0; i < 9; ++i)
        hair.push_back(
            curl({0, 0.006f * static_cast<float>(i % 3), 0.006f * static_cast<float>(i / 3)},
                 i % 2 ? 7 : vertices, 0.012f, 0.9f * static_cast<float>(i)));
    return hair;
}

TEST_P(StrandContact, OffItCostsNothingAndChangesNoBit) {
    auto profiled = plait_context_desc_defaults();
    profiled.backend = GetParam().c_str();
    profiled.profile = 1;
    const plait::Context timed(profiled);
    auto off = meeting();
    off.strand_contact.on = false;
    off.params.bdf2 = 0; // as where strands meet: its history would be made anew
    plait::Sim never(timed, make_groom(crowd()), off), stopped(timed, make_groom(crowd()), off);
    const auto bytes = never.describe().device_bytes;
    stopped.set_all(meeting());
    EXPECT_GT(stopped.describe().device_bytes, bytes);
    stopped.set_all(off);
    EXPECT_EQ(stopped.describe().device_bytes, bytes);
    for (plait::Sim* each : {&never, &stopped})
        (void)launched_stages(*each); // of its making
    run(never, 3);
    run(stopped, 3);
    EXPECT_EQ(never.hash(), stopped.hash());
    EXPECT_EQ(launched_stages(never), launched_stages(stopped));
    stopped.set_all(meeting());
    run(stopped, 2);
    const auto stages = launched_stages(stopped);
    EXPECT_EQ(std::ranges::count(stages, "contact_pair_find"), 2);
    EXPECT_GE(std::ranges::count(stages, "strand_contact"), 2);
}

TEST_P(StrandContact, RepeatsBitForBitAlsoFromASnapshot) {
    plait::Sim one(context, make_groom(crowd()), meeting());
    plait::Sim other(context, make_groom(crowd()), meeting());
    run(one, 10);
    run(other, 10);
    EXPECT_EQ(one.hash(), other.hash());
    const auto saved = one.save();
    one.restore(saved); // the reference, too, goes on from float32
    plait::Sim again(context, make_groom(crowd()), meeting());
    again.restore(saved);
    run(one, 5);
    run(again, 5);
    EXPECT_EQ(one.hash(), again.hash());
}

// Short strands and long ones, and those of other substeps, are in parts of their own.
TEST_P(StrandContact, StrandsOfSeveralPartsMeet) {
    auto desc = meeting();
    desc.params.gravity[1] = 0;
    desc.params.gravity[2] = -9.81f;
    const Strands hair{line({0.1f, -0.1f, 0}, {0, 1, 0}, 0.2f / 15),
                       line({0.06f, 0.005f, 2 * radius}, {1, 0, 0}, 0.0125f, 8)};
    desc.material.bend_stiffness = 1e-10f; // alone it would hang from its root, its tip at -0.0875
    for (const uint32_t other : {1u, 3u}) {
        plait::Sim sim(context, make_groom(hair), desc);
        std::vector<plait_pin> pins;
        for (uint32_t i = 1; i < vertices; ++i)
            pins.push_back(hold(0, i));
        sim.set_pins(pins);
        sim.set_settings({plait_strand_settings_defaults(), of_substeps(other)}, {1, 0});
        run(sim, 60);
        const float tip = sim.read(PLAIT_FIELD_POSITION)[4 * (vertices + 7) + 2];
        EXPECT_GT(tip, -0.065f) << other << ": it lies across the other, its tip hangs";
        EXPECT_EQ(sim.measure().nonfinite, 0u);
    }
}

TEST_P(StrandContact, CountsPairsThatAreDropped) {
    Strands hair;
    for (size_t i = 0; i < 9; ++i)
        hair.push_back(line({0, 1e-4f * static_cast<float>(i), 0}, {1, 0, 0}, 0.01f));
    plait::Sim sim(context, make_groom(hair), meeting());
    run(sim, 1);
    EXPECT_EQ(sim.measure().pairs_dropped, 9u * 15); // beside each segment lie eight
    plait::Sim few(context, make_groom({hair[0], hair[8]}), meeting());
    run(few, 1);
    EXPECT_EQ(few.measure().pairs_dropped, 0u);
}

TEST_P(StrandContact, TressfxRefuses) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_TRESSFX;
    plait::Sim sim(context, make_groom(tuft(2, 4)), desc);
    desc.strand_contact.on = true;
    EXPECT_EQ(plait_sim_set_strand_contact(sim, desc.strand_contact.desc()), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("do not meet each other"), std::string::npos);
    EXPECT_THROW(plait::Sim(context, make_groom(tuft(2, 4)), desc), plait::Error);
}

} // namespace
