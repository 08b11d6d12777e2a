// plait_sim_set_wind: hair in a stream of air, held to closed forms of a slender cylinder's drag, what
// goes on over snapshots, and what it costs where it is off.
#include "mesh_shapes.hpp"
#include "support.hpp"

#include <algorithm>
#include <cstring>
#include <span>

namespace {

// Across the stream at C = 1, per metre of way: rho d/2 over mass per length.
constexpr double drag_per_metre = 0.5 * 1.204 * 70e-6 / 5e-6;

plait::SimDesc weightless(float step = 1.0f / 60) {
    plait::SimDesc desc;
    desc.step = step;
    desc.max_steps_per_call = 1000;
    std::fill_n(desc.params.gravity, 3, 0.0f);
    desc.params.drag = 0;
    return desc;
}

// In the open: what a strand is spread over in the grid would shelter it by a percent or two.
plait_wind_desc blowing(Point velocity) {
    auto wind = plait_wind_desc_defaults();
    wind.shelter = 0;
    std::copy(velocity.begin(), velocity.end(), wind.velocity);
    return wind;
}

plait_wind_desc gusty() {
    auto wind = blowing({2, 0.3f, -1});
    wind.turbulence = 1;
    wind.gusts = 0.3f;
    wind.seed = 5;
    wind.shelter = 1;
    wind.hairs_per_strand = 40;
    return wind;
}

Strand straight(Point direction, size_t segments, float length) {
    Strand strand;
    for (size_t i = 0; i <= segments; ++i) {
        const float s = length * static_cast<float>(i) / static_cast<float>(segments);
        strand.push_back({s * direction[0], s * direction[1], s * direction[2]});
    }
    return strand;
}

Point vertex_of(const std::vector<float>& field, size_t vertex) {
    return {field[4 * vertex], field[4 * vertex + 1], field[4 * vertex + 2]};
}

float distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

class WindOf : public OnBackend {};
ON_EVERY_BACKEND(WindOf);

// Speed (m/s) at which drag across, along k_t = 1/2, takes up `g`: g = drag (v + b v^(1/3)) v.
double terminal_speed(double g, double share) {
    const double viscous = 10 * std::pow(1.516e-5 / 70e-6, 2.0 / 3);
    double low = 0, high = 100;
    for (int i = 0; i < 100; ++i) {
        const double v = (low + high) / 2;
        (share * drag_per_metre * (v + viscous * std::cbrt(v)) * v < g ? low : high) = v;
    }
    return low;
}

// A strand whose root falls as fast as its hair alone would, gliding along itself where it is tilted:
// nothing bends it. By 0.5 % of drag it would by 0.5 % of its sag.
TEST_P(WindOf, StillAirHoldsHairAtItsTerminalSpeed) {
    EXPECT_NEAR(terminal_speed(9.81, 1), 0.38633, 2e-4) << "Re 1.8, C 7.8";
    constexpr float length = 0.1f;
    for (const double tilt : {0.0, 0.5235987755982988, 1.0471975511965976}) {
        auto desc = weightless();
        desc.params.gravity[1] = -9.81f;
        desc.material.bend_stiffness = 1e-6f;
        const double across = terminal_speed(9.81 * std::cos(tilt), 1);
        const double along = terminal_speed(9.81 * std::sin(tilt), 0.5);
        const double c = std::cos(tilt), s = std::sin(tilt); // the strand points down the slope
        const Point v{static_cast<float>(along * c - across * s),
                      static_cast<float>(-along * s - across * c), 0};
        const Strand strand =
            straight({static_cast<float>(c), static_cast<float>(-s), 0}, 10, length);
        plait::Sim sim(context, make_groom({strand}), desc);
        auto wind = blowing({0, 0, 0});
        wind.tangential = 0.5f;
        sim.set_wind(wind);
        std::vector<float> velocity(size_t{4} * 11, 0.0f);
        for (size_t i = 0; i < velocity.size(); i += 4)
            std::copy(v.begin(), v.end(), velocity.begin() + static_cast<long>(i));
        sim.write(PLAIT_FIELD_VELOCITY, velocity);
        Point root{0, 0, 0};
        for (int i = 1; i <= 60; ++i) {
            const float t = static_cast<float>(i) / 60;
            root = {v[0] * t, v[1] * t, 0};
            sim.set_roots(head_at(root));
            run(sim, 1);
        }
        const Point tip = vertex_of(sim.read(PLAIT_FIELD_POSITION), 10);
        const Point at{root[0] + strand[10][0], root[1] + strand[10][1], 0};
        const double weight = 5e-6 * 9.81 * std::cos(tilt), sag = weight / (8 * 1e-6) * 1e-4;
        const double most = 5e-3 * sag + 1e-6;
        EXPECT_LT(distance(tip, at), most) << "at " << tilt;
    }
}

// A wind that starts at once, C = 1: v = U k U t/(1 + k U t). The root goes as a free hair does, so
// that nothing holds the others.
struct Onset {
    float worst = 0, past = 0; // m/s, of the vertices' speeds
};
Onset onset_of(plait::Context& context, int rate, double wind_speed) {
    auto desc = weightless(1.0f / static_cast<float>(rate));
    desc.material.bend_stiffness = 0;
    plait::Sim sim(context, make_groom({straight({0, -1, 0}, 8, 0.2f)}), desc);
    sim.step(1.0 / rate); // a head that is known to rest
    sim.step(1.0 / rate);
    auto wind = blowing({static_cast<float>(wind_speed), 0, 0});
    wind.viscosity = 0;
    sim.set_wind(wind);
    Onset onset;
    for (int i = 1; i <= rate / 2; ++i) {
        const double t = double(i) / rate, k = drag_per_metre, kut = k * wind_speed * t;
        const double exact = wind_speed * kut / (1 + kut);
        const double way = wind_speed * t - std::log1p(kut) / k;
        sim.set_roots(head_at({static_cast<float>(way), 0, 0}));
        sim.step(1.0 / rate);
        const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
        for (size_t vertex = 4; vertex <= 8; ++vertex) {
            const auto v = double(velocity[4 * vertex]);
            onset.worst = std::max(onset.worst, static_cast<float>(std::abs(v - exact)));
            onset.past = std::max(onset.past, static_cast<float>(v - wind_speed));
        }
    }
    return onset;
}

TEST_P(WindOf, ASuddenGustCarriesFreeHairAsTheClosedFormSays) {
    for (const double speed : {0.5, 2.0, 10.0})
        for (const int rate : {30, 60, 240}) {
            const Onset onset = onset_of(context, rate, speed);
            EXPECT_LT(double(onset.past), 1e-4 * speed) << "" << speed << " " << rate;
            if (rate == 240) {
                EXPECT_LT(double(onset.worst), 0.02 * speed) << "" << speed;
            }
        }
}

// A stiff hair in a steady stream, which holds it as a beam under an even load, q = rho d/2 C U^2: at
// any frame rate the same.
TEST_P(WindOf, ASteadyStreamBendsAHairAlikeAtAnyStep) {
    constexpr float length = 0.1f, stiffness = 2e-6f, speed = 3;
    const double viscous = 10 * std::pow(1.516e-5 / 70e-6, 2.0 / 3);
    const double load = 5e-6 * drag_per_metre * double(speed) *
                        (double(speed) + viscous * std::cbrt(double(speed)));
    const double deflection = load * 1e-4 / (8 * double(stiffness));
    for (const int rate : {30, 60, 480}) {
        auto desc = weightless(1.0f / static_cast<float>(rate));
        desc.material.bend_stiffness = stiffness;
        desc.material.stretch_stiffness = 1; // no shear
        plait::Sim sim(context, make_groom({straight({0, -1, 0}, 24, length)}), desc);
        sim.set_wind(blowing({speed, 0, 0}));
        for (int i = 0; i < 3 * rate; ++i)
            sim.step(1.0 / rate);
        const Point tip = vertex_of(sim.read(PLAIT_FIELD_POSITION), 24);
        EXPECT_NEAR(double(tip[0]) / deflection, 1, 0.03) << "" << rate;
    }
}

// Beside what the caller writes, which stays as it is, once per step: as weight would.
TEST_P(WindOf, AccelerationsAddUpWithWind) {
    auto desc = weightless();
    desc.substeps = 2;
    desc.params.gravity[1] = -6;
    plait::Sim heavy(context, make_groom(tuft(4, 10)), desc);
    desc.params.gravity[1] = 0;
    desc.acceleration.on = true;
    plait::Sim sim(context, make_groom(tuft(4, 10)), desc);
    std::vector<float> pull(size_t{4} * 40, 0.0f);
    for (size_t i = 1; i < pull.size(); i += 4)
        pull[i] = -6;
    sim.write(PLAIT_FIELD_ACCELERATION, pull);
    const auto start = sim.read(PLAIT_FIELD_POSITION);
    for (plait::Sim* each : {&heavy, &sim}) {
        each->set_wind(gusty());
        run(*each, 30);
    }
    EXPECT_GT(largest_difference(sim.read(PLAIT_FIELD_POSITION), start), 0.02f);
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), heavy.read(PLAIT_FIELD_POSITION)),
              1e-5f);
    EXPECT_EQ(sim.read(PLAIT_FIELD_ACCELERATION), pull);
}

// Pins of the caller's hold in the wind as they do without.
TEST_P(WindOf, PinsHoldInIt) {
    auto desc = weightless();
    plait::Sim sim(context, make_groom({curl({0, 0, 0}, 13)}), desc);
    const Point at = curl({0, 0, 0}, 13)[12];
    sim.set_pins({{0, 12, PLAIT_PIN_FRAME_REST, {0, 0, 0}, PLAIT_PIN_HELD}});
    sim.set_wind(gusty());
    run(sim, 60);
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    EXPECT_LT(distance(vertex_of(positions, 12), at), 1e-3f);
    EXPECT_GT(distance(vertex_of(positions, 6), curl({0, 0, 0}, 13)[6]), 3e-3f);
}

TEST_P(WindOf, OffItCostsNothingAndChangesNoBit) {
    auto profiled = plait_context_desc_defaults();
    profiled.backend = GetParam().c_str();
    profiled.profile = 1;
    const plait::Context timed(profiled);
    plait::SimDesc desc;
    plait::Sim never(timed, make_groom(tuft(5, 12)), desc);
    plait::Sim stopped(timed, make_groom(tuft(5, 12)), desc);
    stopped.stop_wind(); // of none
    const auto bytes = never.describe().device_bytes;
    EXPECT_EQ(stopped.describe().device_bytes, bytes);
    stopped.set_wind(gusty());
    EXPECT_GT(stopped.describe().device_bytes, bytes);
    stopped.stop_wind();
    EXPECT_EQ(stopped.describe().device_bytes, bytes);
    run(never, 3);
    run(stopped, 3);
    EXPECT_EQ(never.read(PLAIT_FIELD_POSITION), stopped.read(PLAIT_FIELD_POSITION));
    EXPECT_EQ(never.hash(), stopped.hash());
    EXPECT_EQ(launched_stages(never), launched_stages(stopped));
    stopped.set_wind(gusty());
    run(stopped, 3);
    const auto stages = launched_stages(stopped);
    EXPECT_EQ(std::ranges::count(stages, "lane_wind"), 3);
    EXPECT_EQ(std::ranges::count(stages, "wind_field"), 3);
    EXPECT_EQ(std::ranges::count(stages, "wind_obstacle"), 3);
    EXPECT_EQ(std::ranges::count(stages, "wind_shelter"), 3);
    stopped.set_wind(blowing({1, 0, 0}));
    run(stopped, 3);
    for (const char* stage : {"wind_field", "wind_obstacle", "wind_shelter"})
        EXPECT_EQ(std::ranges::count(launched_stages(stopped), stage), 0);
}

// A wind that was changed just before, gusts, eddies on their way: all of it goes on.
TEST_P(WindOf, SnapshotsHoldHowFarItIs) {
    plait::SimDesc desc;
    const plait::Groom groom = make_groom(tuft(5, 12));
    plait::Sim sim(context, groom, desc), again(context, groom, desc);
    sim.set_wind(blowing({-1, 0, 0}));
    run(sim, 10);
    sim.set_wind(gusty());
    again.set_wind(gusty());
    const auto saved = sim.save();
    sim.restore(saved); // the reference, too, goes on from float32
    again.restore(saved);
    EXPECT_EQ(again.hash(), sim.hash());
    run(sim, 10);
    run(again, 10);
    EXPECT_EQ(again.hash(), sim.hash());
    // the hair of the snapshot, in a wind that is not
    plait::Sim other(context, groom, desc);
    other.restore(saved);
    other.set_wind(gusty());
    run(other, 10);
    EXPECT_NE(other.read(PLAIT_FIELD_POSITION), sim.read(PLAIT_FIELD_POSITION));
}

// m, from its middle, and of that along x: of strand `s` in a bundle 8 cm across.
std::pair<double, double> place_in_bundle(size_t s) {
    const double r = 0.04 * std::sqrt((double(s) + 0.5) / 400);
    return {r, r * std::cos(2.399963 * double(s))};
}

// It stands for 60,000 hairs.
std::vector<Strand> bundle() {
    std::vector<Strand> strands;
    for (int i = 0; i < 400; ++i) {
        const auto [r, along] = place_in_bundle(static_cast<size_t>(i));
        Strand strand = straight({0, -1, 0}, 12, 0.15f);
        for (Point& x : strand) {
            x[0] = static_cast<float>(along);
            x[2] = static_cast<float>(r * std::sin(2.399963 * i));
        }
        strands.push_back(strand);
    }
    return strands;
}

// Degrees by which a strand leans along x, from root to tip.
double lean_of(const std::vector<float>& positions, size_t strand) {
    const Point root = vertex_of(positions, 13 * strand);
    const Point tip = vertex_of(positions, 13 * strand + 12);
    return std::atan2(double(tip[0] - root[0]), double(root[1] - tip[1])) * 180 / 3.14159265358979;
}

// Of a bundle whose head goes on at 2 m/s along x, the mean over two seconds, in which what still swings
// swings out.
struct Lean {
    double inside = 0, front = 0;
};
Lean mean_lean(plait::Sim& sim) {
    Lean lean;
    for (int i = 1; i <= 240; ++i) { // from rest within half a second
        const float t = static_cast<float>(i) / 60;
        sim.set_roots(head_at({t < 0.5f ? 2 * t * t : 2 * t - 0.5f, 0, 0}));
        run(sim, 1);
        if (i <= 120)
            continue;
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        double inside = 0, number = 0, front = 0;
        for (size_t s = 0; s < 400; ++s) {
            const auto [r, x] = place_in_bundle(s);
            if (r < 0.015) {
                inside += lean_of(positions, s);
                ++number;
            }
            if (x > 0.037)
                front = std::min(front, lean_of(positions, s));
        }
        lean.inside += inside / number / 120;
        lean.front += front / 120;
    }
    return lean;
}

// A head that goes on at 2 m/s through still air takes the air in its hair along: inside nothing tilts,
// at the rim the wind is felt. In the open all of it lies flat.
TEST_P(WindOf, HairIsShelteredByHair) {
    for (const uint32_t shelter : {1u, 0u}) {
        plait::SimDesc desc;
        desc.params.drag = 0; // which is relative to air at rest
        plait::Sim sim(context, make_groom(bundle()), desc);
        auto wind = blowing({0, 0, 0});
        wind.shelter = shelter;
        wind.hairs_per_strand = 150;
        sim.set_wind(wind);
        const Lean lean = mean_lean(sim);
        if (shelter) {
            EXPECT_LT(std::abs(lean.inside), 0.5);
            EXPECT_LT(lean.front, -5);
        } else {
            EXPECT_LT(lean.inside, -60);
        }
    }
}

// Degrees by which a hair leans in wind along x, beside a body that `add` makes around a place.
template <typename Add> double lean_beside(const plait::Context& context, float x, const Add& add) {
    plait::Sim sim(context, make_groom({straight({0, -1, 0}, 12, 0.15f)}));
    add(sim, Point{x, -0.075f, 0});
    auto wind = blowing({1, 0, 0});
    wind.shelter = 1;
    sim.set_wind(wind);
    run(sim, 120);
    return lean_of(sim.read(PLAIT_FIELD_POSITION), 0);
}

constexpr float body_radius = 0.09f;

// Behind a sphere the wind does not blow.
TEST_P(WindOf, HairIsShelteredByColliders) {
    const auto add_sphere = [](plait::Sim& sim, const Point& at) {
        auto collider = smooth_collider();
        std::copy(at.begin(), at.end(), collider.capsule.a);
        std::copy(at.begin(), at.end(), collider.capsule.b);
        collider.capsule.radius_a = collider.capsule.radius_b = body_radius;
        sim.create_collider(collider);
    };
    EXPECT_LT(std::abs(lean_beside(context, -0.12f, add_sphere)), 1);
    EXPECT_GT(lean_beside(context, 0.12f, add_sphere), 10) << "and against the sphere";
}

// Nor behind one of triangles, whichever way hair meets it; one that bends has grown to that size.
TEST_P(WindOf, HairIsShelteredByMeshes) {
    for (const plait_mesh_form form : {PLAIT_MESH_FORM_FIELD, PLAIT_MESH_FORM_NEAREST}) {
        const auto add_ball = [&](plait::Sim& sim, const Point& at) {
            const bool grows = form == PLAIT_MESH_FORM_NEAREST;
            const double radius = double(body_radius);
            const ShapeMesh ball = ellipsoid_mesh(radius, radius, radius, 24, 12);
            const double small = grows ? 0.1 * radius : radius;
            const ShapeMesh begin = ellipsoid_mesh(small, small, small, 24, 12);
            auto given = plait_mesh_desc_defaults();
            given.positions = {begin.positions.data(), begin.positions.size(), 0};
            given.triangles = {begin.triangles.data(), begin.triangles.size(), 0};
            auto desc = plait_collider_mesh_desc_defaults();
            desc.form = form;
            std::copy(at.begin(), at.end(), desc.pose.t);
            const auto id = sim.create_collider(plait::Mesh(given), desc);
            if (grows)
                sim.set_collider_positions(id, {ball.positions.data(), ball.positions.size(), 0});
        };
        EXPECT_LT(std::abs(lean_beside(context, -0.12f, add_ball)), 1) << "form " << form;
        EXPECT_GT(lean_beside(context, 0.12f, add_ball), 10) << "form " << form;
    }
}

TEST_P(WindOf, BeginsAnewWithAReset) {
    plait::Sim sim(context, make_groom(tuft(5, 12)));
    sim.set_wind(gusty());
    run(sim, 7);
    const auto first = sim.read(PLAIT_FIELD_POSITION);
    sim.reset();
    run(sim, 7);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), first);
}

// Strands that come to another part, of other substeps, meet the same wind.
TEST_P(WindOf, StaysOverSwitches) {
    plait::Sim sim(context, make_groom(tuft(6, 12)), weightless());
    sim.set_wind(blowing({2, 0, 0}));
    run(sim, 5);
    sim.set_settings({plait_strand_settings_defaults(), of_substeps(3)}, {0, 1, 0, 1, 0, 1});
    run(sim, 60);
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    for (size_t strand = 0; strand < 6; ++strand)
        EXPECT_GT(positions[4 * (12 * strand + 11)], 0.17f) << "laid along x, " << strand;
    EXPECT_EQ(sim.measure().nonfinite, 0u);
}

TEST_P(WindOf, ValuesOutOfRangeAreRefusedByName) {
    plait::Sim sim(context, make_groom(tuft(2, 6)));
    const uint64_t before = sim.hash();
    const auto refused = [&](const char* name, auto change) {
        auto wind = plait_wind_desc_defaults();
        change(wind);
        EXPECT_EQ(plait_sim_set_wind(sim, &wind), PLAIT_INVALID_ARGUMENT) << name;
        EXPECT_NE(std::strstr(plait_last_error(), name), nullptr) << plait_last_error();
    };
    using W = plait_wind_desc;
    refused("velocity[1]", [](W& w) { w.velocity[1] = NAN; });
    refused("velocity[2]", [](W& w) { w.velocity[2] = 1001; });
    refused("turbulence", [](W& w) { w.turbulence = -1; });
    refused("scale", [](W& w) { w.scale = 0; });
    refused("octaves", [](W& w) { w.octaves = 9; });
    refused("octaves", [](W& w) { w.octaves = 0; });
    refused("gain", [](W& w) { w.gain = 1.1f; });
    refused("gusts", [](W& w) { w.gusts = 3; });
    refused("gust_period", [](W& w) { w.gust_period = 0; });
    refused("tangential", [](W& w) { w.tangential = 2; });
    refused("diameter", [](W& w) { w.diameter = -1e-5f; });
    refused("air_density", [](W& w) { w.air_density = 0; });
    refused("viscosity", [](W& w) { w.viscosity = INFINITY; });
    refused("shelter", [](W& w) { w.shelter = 2; });
    refused("hairs_per_strand", [](W& w) { w.hairs_per_strand = -1; });
    EXPECT_EQ(sim.hash(), before);
}

TEST_P(WindOf, TressfxHasItsOwn) {
    plait::Sim sim(context, make_groom(tuft(2, 6)), tressfx_desc());
    const auto wind = plait_wind_desc_defaults();
    EXPECT_EQ(plait_sim_set_wind(sim, &wind), PLAIT_INVALID_STATE);
    EXPECT_NE(std::strstr(plait_last_error(), "tressfx"), nullptr) << plait_last_error();
    EXPECT_EQ(plait_sim_set_wind(sim, nullptr), PLAIT_OK) << "there is none";
}

} // namespace
