// Pins: PLAIT_FIELD_PIN and plait_sim_set_pins. What they hold and how far it gives, what of a
// strand between two of them is known in closed form, and who carries them.
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>

namespace {

plait::SimDesc pinnable(uint32_t substeps = 1) {
    plait::SimDesc desc;
    desc.substeps = substeps;
    return desc;
}

plait_pin hold(uint32_t strand, uint32_t vertex) {
    return {strand, vertex, PLAIT_PIN_FRAME_REST, {0, 0, 0}, PLAIT_PIN_HELD};
}

plait_pin hold_at(uint32_t strand, uint32_t vertex, Point target,
                  float stiffness = PLAIT_PIN_HELD) {
    return {strand, vertex, PLAIT_PIN_FRAME_WORLD, {target[0], target[1], target[2]}, stiffness};
}

Point vertex_of(const std::vector<float>& field, size_t vertex) {
    return {field[4 * vertex], field[4 * vertex + 1], field[4 * vertex + 2]};
}

Point position_of(plait::Sim& sim, size_t vertex) {
    return vertex_of(sim.read(PLAIT_FIELD_POSITION), vertex);
}

float distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Straight from the origin along x.
Strand straight(size_t segments, float length) {
    Strand strand;
    for (size_t i = 0; i <= segments; ++i)
        strand.push_back({length * static_cast<float>(i) / static_cast<float>(segments), 0, 0});
    return strand;
}

// Half a circle that hangs below the x axis: what presses a straight limp strand meets no side to
// turn it to.
Strand bow(size_t segments, float length) {
    Strand strand{{0, 0, 0}};
    const float l = length / static_cast<float>(segments);
    for (size_t i = 0; i < segments; ++i) {
        const float angle = std::numbers::pi_v<float> *
                            ((static_cast<float>(i) + 0.5f) / static_cast<float>(segments) - 0.5f);
        const Point& last = strand.back();
        strand.push_back({last[0] + l * std::cos(angle), last[1] + l * std::sin(angle), 0});
    }
    return strand;
}

class Pins : public OnBackend {};
ON_EVERY_BACKEND(Pins);

// 10 g of a strand that hangs in a slack bow, at any frame rate: 5 % of a segment.
TEST_P(Pins, HoldUnderTenG) {
    constexpr float spacing = 0.02f;
    for (const float step : {1.0f / 30, 1.0f / 60, 1.0f / 240}) {
        auto desc = pinnable();
        desc.step = step;
        std::copy_n(Point{30, -90, 20}.begin(), 3, desc.params.gravity);
        plait::Sim sim(context, make_groom({curl({0, 0, 0}, 17, spacing)}), desc);
        const Point middle{0.1f, 0.02f, 0}, tip{0.19f, -0.05f, 0.02f};
        sim.set_pins({hold_at(0, 8, middle), hold_at(0, 16, tip)});
        for (int i = 0; i < static_cast<int>(0.4f / step); ++i)
            sim.step(double(step));
        for (int i = 0; i < 10; ++i) {
            sim.step(double(step));
            EXPECT_LT(distance(position_of(sim, 8), middle), 0.05f * spacing) << step;
            EXPECT_LT(distance(position_of(sim, 16), tip), 0.05f * spacing) << step;
        }
    }
}

// Of a limp strand of length 1 between two points `span` apart: its parameter a, horizontal tension
// over weight per length, from 2 a sinh(span/2a) = 1.
double catenary(double span) {
    double low = 0.01, high = 100;
    for (int i = 0; i < 200; ++i) {
        const double a = (low + high) / 2;
        (2 * a * std::sinh(span / 2 / a) > 1 ? low : high) = a;
    }
    return low;
}

// Sag of the lowest vertex within 1e-3 of the length, and the pin's spring pulls with the
// horizontal tension.
TEST_P(Pins, HangALimpStrandAsACatenary) {
    constexpr size_t segments = 20;
    constexpr float length = 0.3f, stiffness = 0.1f;
    auto desc = pinnable();
    desc.material.bend_stiffness = 0;
    desc.params.drag = 10;
    desc.material.stretch_stiffness = 0.1f;
    plait::Sim sim(context, make_groom({bow(segments, length)}), desc);
    const Point target{0.7f * length, 0, 0};
    sim.set_pins({hold_at(0, segments, target, stiffness)});
    run(sim, 240);
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const Point tip = vertex_of(positions, segments);
    double lowest = 0;
    for (size_t i = 0; i <= segments; ++i)
        lowest = std::min(lowest, double(vertex_of(positions, i)[1]));
    const double span = std::hypot(double(tip[0]), double(tip[1])) / double(length);
    const double a = catenary(span), sag = a * (std::cosh(span / 2 / a) - 1);
    EXPECT_NEAR((double(tip[1]) / 2 - lowest) / double(length), sag, 1e-3);
    const double weight = double(desc.material.line_density) * 9.81;
    const double pull = double(stiffness) * double(target[0] - tip[0]);
    EXPECT_NEAR(pull / (weight * a * double(length)), 1, 0.02);
    EXPECT_NEAR(double(tip[2]), 0, 1e-6);
}

// A cantilever that a spring draws aside by F = k (d - w) = 3 EI w/L^3.
TEST_P(Pins, BendARodAsAPointLoadDoes) {
    constexpr float length = 0.2f, aside = 0.01f;
    auto desc = pinnable();
    std::fill_n(desc.params.gravity, 3, 0.0f);
    desc.params.drag = 5;
    const double rate = 3 * double(desc.material.bend_stiffness) / std::pow(double(length), 3);
    const auto stiffness = static_cast<float>(rate);
    plait::Sim sim(context, make_groom({straight(16, length)}), desc);
    sim.set_pins({hold_at(0, 16, {length, aside, 0}, stiffness)});
    run(sim, 480);
    EXPECT_NEAR(position_of(sim, 16)[1] / (aside / 2), 1, 0.02);
}

// Along with a target that swings, and nothing gains by it: once it stands, all that moves dies
// out.
TEST_P(Pins, DriveAVertexAndGiveNoEnergy) {
    constexpr float spacing = 0.02f;
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 13, spacing)}), pinnable(2));
    const auto target = [](int i) {
        const float t = static_cast<float>(i) / 60;
        return Point{0.15f, -0.05f, 0.03f * std::sin(2 * std::numbers::pi_v<float> * t)};
    };
    sim.set_pins({hold_at(0, 12, target(0))});
    run(sim, 60);
    for (int i = 1; i <= 120; ++i) {
        sim.set_pins({hold_at(0, 12, target(i))});
        run(sim, 1);
        EXPECT_LT(distance(position_of(sim, 12), target(i)), 0.1f * spacing) << "" << i;
    }
    const auto fastest = [&](int steps) {
        float most = 0;
        for (int i = 0; i < steps; ++i) {
            run(sim, 1);
            most = std::max(most, sim.measure().max_speed);
        }
        return most;
    };
    const float moving = fastest(10);
    EXPECT_GT(moving, 0.01f);
    run(sim, 240);
    EXPECT_LT(fastest(10), 0.05f * moving);
}

// A swinging strand without drag and weight keeps at most what it was given.
TEST_P(Pins, HoldAStrandThatSwingsWithoutGain) {
    auto desc = pinnable(2);
    std::fill_n(desc.params.gravity, 3, 0.0f);
    desc.params.drag = 0;
    desc.material.bend_stiffness = 0;
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 13)}), desc);
    sim.set_pins({hold_at(0, 12, {0.18f, 0, 0})});
    run(sim, 120);
    std::vector<float> velocity(size_t{4} * 13, 0.0f);
    for (size_t i = 1; i < 12; ++i)
        velocity[4 * i + 2] =
            0.5f * std::sin(std::numbers::pi_v<float> * static_cast<float>(i) / 12.0f);
    sim.write(PLAIT_FIELD_VELOCITY, velocity);
    const auto energy = [&] { // over half a vertex' mass
        double sum = 0;
        for (const float v : sim.read(PLAIT_FIELD_VELOCITY))
            sum += double(v) * double(v);
        return sum;
    };
    const double begin = energy();
    for (int i = 0; i < 240; ++i) {
        run(sim, 1);
        EXPECT_LT(energy(), 1.01 * begin) << "step " << i;
    }
}

// A tie goes with the head, though nobody writes it, at frame rates that no step fits.
TEST_P(Pins, AtRestGoWithTheHead) {
    const Strand strand = curl({0, 0, 0}, 13);
    plait::Sim sim(context, make_groom({strand}), pinnable(2));
    sim.set_pins({hold(0, 6)});
    for (int i = 1; i <= 144; ++i) {
        const float angle = 0.4f * std::sin(0.05f * static_cast<float>(i));
        const auto roots = head_at({0.1f * std::sin(0.03f * static_cast<float>(i)), 0, 0},
                                   {0, std::sin(angle / 2), 0, std::cos(angle / 2)});
        sim.set_roots(roots);
        sim.step(1.0 / 144);
    }
    sim.step(frame); // the last step ends where the head stands
    const auto roots = head_at({0.1f * std::sin(0.03f * 144), 0, 0});
    const float angle = 0.4f * std::sin(0.05f * 144);
    const Point& p = strand[6];
    const Point at{roots.head.t[0] + std::cos(angle) * p[0] + std::sin(angle) * p[2], p[1],
                   -std::sin(angle) * p[0] + std::cos(angle) * p[2]};
    EXPECT_LT(distance(position_of(sim, 6), at), 0.05f * 0.02f);
}

// In the world a target goes from where it was to where it is as roots do: with the head's own path
// it is what the head carries.
TEST_P(Pins, InTheWorldInterpolateAsRootsDo) {
    for (const double dt : {1.0 / 144, 1.0 / 30, 1.0 / 60}) {
        const Strand strand = curl({0, 0, 0}, 13);
        plait::Sim carried(context, make_groom({strand}), pinnable());
        plait::Sim followed(context, make_groom({strand}), pinnable());
        carried.set_pins({hold(0, 12)});
        followed.set_pins({hold_at(0, 12, strand[12])});
        carried.teleport(head_at({0, 0, 0}));
        followed.teleport(head_at({0, 0, 0}));
        for (int i = 1; i <= 60; ++i) {
            const float x = 0.1f * std::sin(0.1f * static_cast<float>(i));
            const Point& p = strand[12];
            followed.set_pins({hold_at(0, 12, {p[0] + x, p[1], p[2]})});
            carried.set_roots(head_at({x, 0, 0}));
            followed.set_roots(head_at({x, 0, 0}));
            carried.step(dt);
            followed.step(dt);
            ASSERT_LT(largest_difference(carried.read(PLAIT_FIELD_POSITION),
                                         followed.read(PLAIT_FIELD_POSITION)),
                      5e-5f)
                << dt << ", call " << i;
        }
    }
}

// What is not used costs nothing: neither a launch, nor a byte, nor a bit.
TEST_P(Pins, OfNoneChangeNoBitAndOffCostNothing) {
    auto profiled = plait_context_desc_defaults();
    profiled.backend = GetParam().c_str();
    profiled.profile = 1;
    const plait::Context timed(profiled);
    const auto desc = pinnable(2);
    plait::Sim on(timed, make_groom(tuft(5, 12)), desc);
    plait::Sim off(timed, make_groom(tuft(5, 12)), desc);
    on.write(PLAIT_FIELD_PIN, std::vector<float>(size_t{4} * 5 * 12, 0.0f));
    for (plait::Sim* each : {&on, &off})
        (void)launched_stages(*each); // of what was before
    run(on, 3);
    run(off, 3);
    EXPECT_EQ(on.read(PLAIT_FIELD_POSITION), off.read(PLAIT_FIELD_POSITION));
    const auto with = launched_stages(on), without = launched_stages(off);
    EXPECT_EQ(std::ranges::count(with, "lane_pin"), 6); // a substep each
    EXPECT_EQ(std::ranges::count(with, "pins"), 6);     // a step and a call each
    EXPECT_EQ(with.size(), without.size() + 12);
    EXPECT_GE(on.describe().device_bytes, off.describe().device_bytes + 5 * 12 * 5 * 16);
}

// No strand but the pinned one moves otherwise; a lock that is let go is as free as ever.
TEST_P(Pins, AreOfTheirStrandAndLetGo) {
    plait::Sim sim(context, make_groom(tuft(5, 12)), pinnable());
    plait::Sim free(context, make_groom(tuft(5, 12)), pinnable());
    sim.set_pins({hold(2, 11), hold(2, 5)});
    run(sim, 20);
    run(free, 20);
    const auto held = sim.read(PLAIT_FIELD_POSITION), fell = free.read(PLAIT_FIELD_POSITION);
    const auto strand = [](const std::vector<float>& field, size_t k) {
        return std::vector<float>(field.begin() + 48 * k, field.begin() + 48 * (k + 1));
    };
    for (const size_t k : {0, 1, 3, 4})
        EXPECT_EQ(strand(held, k), strand(fell, k));
    EXPECT_GT(largest_difference(strand(held, 2), strand(fell, 2)), 0.05f);
    const float before = held[4 * (2 * 12 + 11) + 1];
    sim.set_pins({});
    run(sim, 20);
    EXPECT_LT(sim.read(PLAIT_FIELD_POSITION)[4 * (2 * 12 + 11) + 1], before - 0.05f);
}

TEST_P(Pins, StayOverSwitchesResetAndTeleport) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), pinnable());
    sim.set_pins({hold(1, 7)});
    const auto pins = sim.read(PLAIT_FIELD_PIN);
    const Point rest = vertex_of(sim.read(PLAIT_FIELD_REST), 8 + 7);
    const auto off = [&] { return distance(position_of(sim, 8 + 7), rest); };
    for (const uint32_t substeps : {1u, 3u}) {
        take_substeps(sim, {substeps, substeps, substeps});
        run(sim, 30);
        EXPECT_LT(off(), 2e-3f) << substeps;
    }
    sim.reset();
    run(sim, 30);
    EXPECT_LT(off(), 2e-3f);
    sim.teleport(head_at({3, 0, 0}));
    EXPECT_NEAR(position_of(sim, 8 + 7)[0], rest[0] + 3, 3e-3f);
    run(sim, 5);
    EXPECT_NEAR(position_of(sim, 8 + 7)[0], rest[0] + 3, 3e-3f) << "no way back, no way on";
    EXPECT_EQ(sim.read(PLAIT_FIELD_PIN), pins);
}

TEST_P(Pins, AreInSnapshots) {
    const auto desc = pinnable(2);
    plait::Sim sim(context, make_groom(tuft(3, 8)), desc);
    sim.set_pins({hold_at(1, 7, {0.1f, 0, 0}), hold(2, 4)});
    run(sim, 3);
    sim.set_pins({hold_at(1, 7, {0.12f, 0, 0}), hold(2, 4)});
    sim.step(0.005); // on its way
    const auto saved = sim.save();
    const auto go_on = [](plait::Sim& other) {
        run(other, 5);
        return other.read(PLAIT_FIELD_POSITION);
    };
    const auto goes_on = go_on(sim);
    plait::Sim other(context, make_groom(tuft(3, 8)), desc);
    other.set_pins({hold(0, 3)});
    other.restore(saved);
    // `reference` keeps doubles and a snapshot floats: there the futures differ by rounding.
    EXPECT_LT(largest_difference(go_on(other), goes_on), GetParam() == "opencl" ? 1e-30f : 1e-6f);
    EXPECT_EQ(other.read(PLAIT_FIELD_PIN), sim.read(PLAIT_FIELD_PIN));
    // without any, and into a sim that has none
    plait::Sim none(context, make_groom(tuft(3, 8)), desc);
    other.restore(none.save());
    EXPECT_EQ(other.read(PLAIT_FIELD_PIN), std::vector<float>(size_t{4} * 3 * 8, 0));
    none.restore(saved);
    EXPECT_EQ(none.read(PLAIT_FIELD_PIN), sim.read(PLAIT_FIELD_PIN));
    run(none, 1);
}

TEST_P(Pins, AreWrittenAsOneFieldToo) {
    plait::Sim listed(context, make_groom(tuft(2, 8)), pinnable());
    plait::Sim written(context, make_groom(tuft(2, 8)), pinnable());
    listed.set_pins({hold_at(0, 7, {0.1f, 0, 0}, 0.5f), hold(1, 5)});
    const auto pins = listed.read(PLAIT_FIELD_PIN);
    const Point rest = vertex_of(listed.read(PLAIT_FIELD_REST), 8 + 5);
    EXPECT_EQ(vertex_of(pins, 8 + 5), rest);
    EXPECT_EQ(pins[4 * 7 + 3], 0.5f);
    EXPECT_EQ(pins[4 * (8 + 5) + 3], -PLAIT_PIN_HELD);
    written.write(PLAIT_FIELD_PIN, pins);
    run(listed, 5);
    run(written, 5);
    EXPECT_EQ(listed.read(PLAIT_FIELD_POSITION), written.read(PLAIT_FIELD_POSITION));
}

TEST_P(Pins, OfNoneTakeNoMemory) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    const std::vector<float> none(size_t{4} * 3 * 8, 0);
    const uint64_t bytes = sim.describe().device_bytes;
    EXPECT_EQ(sim.read(PLAIT_FIELD_PIN), none);
    sim.set_pins({hold(0, 7)});
    EXPECT_GE(sim.describe().device_bytes, bytes + 3 * 8 * 4 * 16);
    sim.set_pins({});
    EXPECT_EQ(sim.describe().device_bytes, bytes);
    EXPECT_EQ(sim.read(PLAIT_FIELD_PIN), none);
}

TEST_P(Pins, AreRefusedByTressfx) {
    plait::Sim sim(context, make_groom(tuft(3, 8)), tressfx_desc());
    const plait_pin pin = hold(0, 7);
    const std::vector<float> none(size_t{4} * 3 * 8, 0);
    size_t size = 0;
    for (const plait_result result :
         {plait_sim_set_pins(sim, &pin, 1), plait_sim_read(sim, PLAIT_FIELD_PIN, nullptr, &size),
          plait_sim_write(sim, PLAIT_FIELD_PIN, none.data(), 4 * none.size())})
        EXPECT_EQ(result, PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("those of articulated do"), std::string::npos)
        << plait_last_error();
}

TEST_P(Pins, ThatAreWrongAreRefusedWhole) {
    const Strands strands{curl({0, 0, 0}, 8), curl({0, 0.1f, 0}, 5)};
    plait::Sim sim(context, make_groom(strands), pinnable());
    sim.set_pins({hold(0, 3)});
    const auto before = sim.read(PLAIT_FIELD_PIN);
    const auto refused = [&](const std::vector<plait_pin>& pins, const std::string& words) {
        EXPECT_EQ(plait_sim_set_pins(sim, pins.data(), pins.size()), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(words), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(sim.read(PLAIT_FIELD_PIN), before);
    };
    refused({hold(0, 1), hold(2, 1)}, "pins[1] (strand 2, vertex 1): strand is 2, range is [0, 1]");
    refused({hold(1, 5)}, "vertex is 5, range is [1, 4]");
    refused({hold(1, 0)}, "vertex is 0, range is [1, 4]: vertex 0 is held by its root");
    refused({hold(0, 2), hold(0, 2)}, "vertex 2 of strand 0 is pinned before");
    refused({hold_at(0, 2, {0, NAN, 0})}, "target[1] is nan, range is [-1e6, 1e6] m");
    for (const float bad : {0.0f, -1.0f, 2e6f, NAN})
        refused({hold_at(0, 2, {0, 0, 0}, bad)}, "stiffness is ");
    plait_pin odd = hold(0, 2);
    const int32_t frame = 3;
    std::memcpy(&odd.frame, &frame, sizeof frame);
    refused({odd}, "frame is 3, range is [0, 2]");
    for (const size_t at : {size_t{3}, size_t{4 * 10 + 3}, size_t{4 * 10 + 1}}) {
        auto values = before;
        values[at] = at == 3 ? 1.0f : NAN;
        EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_PIN, values.data(), 4 * values.size()),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(at == 3 ? "pin[0].w" : "pin[10]."),
                  std::string::npos)
            << plait_last_error();
        EXPECT_EQ(sim.read(PLAIT_FIELD_PIN), before);
    }
}

} // namespace
