// The laboratory's own arithmetic, against closed forms and reference tables.
#include "metrics/metrics.hpp"
#include "common/collider_reader.hpp"
#include "common/json_reader.hpp"
#include "levels/levels.hpp"
#include "references/elastic.hpp"
#include "references/modes.hpp"
#include "references/statics.hpp"
#include "references/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

using lab::Vec3;

namespace {

lab::PlaneRod level(double gamma, size_t segments) {
    lab::PlaneRod rod;
    rod.lengths.assign(segments, 1.0 / static_cast<double>(segments));
    rod.bend_stiffness = 1 / gamma;
    rod.law = lab::JointLaw::angle;
    return rod;
}

TEST(LabStatics, is_the_table_of_discrete_cantilevers) {
    const lab::Table& table = lab::load_table("cantilever_discrete.csv");
    ASSERT_GE(table.rows.size(), 20u);
    for (const auto& row : table.rows) {
        const auto shape = hanging_shape(level(row[0], static_cast<size_t>(row[1])));
        ASSERT_FALSE(shape.empty()) << "gamma " << row[0] << ", N " << row[1];
        EXPECT_NEAR(shape.back().x(), row[2], 1e-9) << "gamma " << row[0] << ", N " << row[1];
        EXPECT_NEAR(shape.back().y(), row[3], 1e-9) << "gamma " << row[0] << ", N " << row[1];
    }
}

TEST(LabStatics, is_the_elastica_in_the_limit) {
    for (const auto& row : lab::load_table("cantilever.csv").rows) {
        const Eigen::Vector2d tip = elastica_tip(level(row[0], 16));
        EXPECT_NEAR(tip.x(), row[1], 2e-7) << "gamma " << row[0];
        EXPECT_NEAR(tip.y(), row[2], 2e-7) << "gamma " << row[0];
    }
}

// Small loads: y = -w L^4 / 8 EI, less half of a joint's share.
TEST(LabStatics, bends_like_a_beam_when_stiff) {
    const auto shape = hanging_shape(level(1e-3, 64));
    EXPECT_NEAR(shape.back().y(), -1e-3 / 8, 1e-3 / 8 * 2e-3);
}

TEST(LabStatics, both_joint_laws_agree_for_small_turns) {
    lab::PlaneRod rod = level(10, 128);
    const auto angle = hanging_shape(rod);
    rod.law = lab::JointLaw::cosserat;
    const auto cosserat = hanging_shape(rod);
    EXPECT_LT((angle.back() - cosserat.back()).norm(), 1e-4);
}

TEST(LabStatics, hangs_from_any_clamp) {
    for (const double clamp : {-1.5, -0.5, 0.7, 1.5}) {
        lab::PlaneRod rod = level(1e5, 32);
        rod.clamp = clamp;
        const auto shape = hanging_shape(rod);
        ASSERT_FALSE(shape.empty());
        EXPECT_LT(shape.back().y(), -0.9) << "clamp " << clamp; // limp: it hangs
    }
}

TEST(LabModes, are_the_table_of_hanging_chains) {
    const lab::Table& table = lab::load_table("chain_modes.csv");
    ASSERT_GE(table.rows.size(), 12u);
    for (const auto& row : table.rows) {
        const auto n = static_cast<size_t>(row[1]);
        const std::vector<double> lengths(n, 1.0 / static_cast<double>(n));
        const lab::HangingChain chain{lengths, 1, row[0] > 0, 0};
        EXPECT_NEAR(chain.frequencies(1)[0], row[2], 1e-9) << n << " segments";
    }
}

// A clamped hanging beam, w1 in sqrt(g/L) by collocation of the continuum.
TEST(LabModes, bend) {
    for (const auto& [gamma, w1] : {std::pair{1.0, 3.73262539156},
                                    {10.0, 1.67340875302},
                                    {100.0, 1.28687415686},
                                    {1000.0, 1.22365920436}}) {
        const std::vector<double> lengths(200, 1.0 / 200);
        const lab::HangingChain chain{lengths, 1, true, 1 / gamma};
        EXPECT_NEAR(chain.frequencies(1)[0], w1, 3e-4 * w1) << "gamma " << gamma;
    }
}

TEST(LabSwing, finds_frequency_and_damping) {
    for (const double zeta : {0.0, 0.002, 0.05}) {
        std::vector<double> signal;
        const double omega = 6.77;
        for (int k = 0; k < 600; ++k) {
            const double t = k / 60.0;
            signal.push_back(std::exp(-zeta * omega * t) *
                             std::cos(omega * std::sqrt(1 - zeta * zeta) * t));
        }
        const lab::Swing swing = lab::fit_swing(signal, 1 / 60.0);
        EXPECT_NEAR(swing.frequency / (omega * std::sqrt(1 - zeta * zeta)), 1, 1e-4) << zeta;
        EXPECT_NEAR(swing.damping, zeta, 2e-4 + 2e-3 * zeta) << zeta;
    }
    EXPECT_EQ(lab::fit_swing({0, 1, 2, 3}, 1).frequency, 0);
    EXPECT_EQ(lab::fit_swing({2, 3, 2, -1, -2, -1}, 1).frequency, 0) << "one crossing";
    const lab::Swing short_lived = lab::fit_swing({1, 4, 1, -1, -2, -1, 1, 1, 1}, 1);
    EXPECT_NEAR(short_lived.frequency, lab::pi / 3, 1e-12) << "two crossings, 3 apart";
    EXPECT_NEAR(short_lived.damping, std::log(2) / lab::pi, 1e-12) << "peaks of 4 and 2";
}

TEST(LabMetrics, strain_is_the_worst_segment) {
    EXPECT_NEAR(lab::strain_at({1, 1}, {Vec3(0, 0, 0), Vec3(1.02, 0, 0), Vec3(1.02, 0.9, 0)}), 0.1,
                1e-12);
    EXPECT_TRUE(std::isnan(lab::strain_at({1}, {Vec3(0, 0, 0), Vec3(NAN, 0, 0)})));
}

// A recording made by hand: x(t) of every vertex, at 10 Hz.
class LabRecording : public testing::Test {
  protected:
    template <typename X> void fill(double seconds, const X& x) {
        for (int k = 0; k <= std::lround(10 * seconds); ++k) {
            lab::Frame frame{k / 10.0, {}, {{}}, {{}}};
            for (size_t i = 0; i < 3; ++i) {
                frame.x[0].push_back(x(k / 10.0, i));
                frame.v[0].push_back((x(k / 10.0 + 1e-6, i) - x(k / 10.0 - 1e-6, i)) / 2e-6);
            }
            recording_.frames.push_back(frame);
        }
        recording_.rest = {recording_.frames[0].x[0]};
    }
    double metric(const char* name, double from = 0, double to = 1e9, double expect = 0) {
        lab::Measure measure;
        measure.metric = name;
        measure.from = from;
        measure.to = to;
        measure.expect = expect;
        return evaluate(scene_, method_, recording_, measure).value;
    }

    lab::Scene scene_ = lab::read_scene(lab::Json{{"strand", {{"segments", 2}, {"length", 2}}},
                                                  {"gravity", {0, -10, 0}},
                                                  {"rate", 10}},
                                        {});
    lab::Method method_{lab::find_model("chain"), {}};
    lab::Recording recording_;
};

TEST_F(LabRecording, interpolates_cubics_exactly_inside) {
    fill(1, [](double t, size_t i) { return Vec3(t * t + static_cast<double>(i), t, 0); });
    const auto x = positions_at(recording_, 0, 0.537);
    EXPECT_NEAR(x[2].x(), 0.537 * 0.537 + 2, 1e-12);
}

TEST_F(LabRecording, tilt_is_from_gravity) {
    fill(1, [](double, size_t i) -> Vec3 { return Vec3(1, -1, 0) * static_cast<double>(i); });
    EXPECT_NEAR(metric("tilt"), 45, 1e-9);
    EXPECT_NEAR(metric("tilt", 0, 1e9, 40), 5, 1e-9);
}

TEST_F(LabRecording, travel_and_speed_of_the_tip) {
    fill(2, [](double t, size_t i) { return Vec3(0.5 * t * static_cast<double>(i), 0, 0); });
    EXPECT_NEAR(metric("tip_travel", 1, 2), 0.5, 1e-12); // 1 m of 2 m
    EXPECT_NEAR(metric("tip_speed", 1, 2), 0.5, 1e-12);
    EXPECT_NEAR(metric("speed_max"), 1, 1e-9);
}

TEST_F(LabRecording, acceleration_is_of_the_tip_over_what_was_expected) {
    fill(2, [](double t, size_t i) { return Vec3(1.5 * t * t * static_cast<double>(i), 0, 1); });
    EXPECT_NEAR(metric("acceleration", 0.5, 1.5, 5), 0.2, 1e-9); // 6 m/s^2
    EXPECT_TRUE(std::isnan(metric("acceleration", 0.5, 1.5, 0)));
    EXPECT_TRUE(std::isnan(metric("acceleration", 0.5, 0.6, 5)));
}

TEST_F(LabRecording, jitter_is_rms_per_frame) {
    fill(1, [](double t, size_t i) { return Vec3(i ? 0.01 * std::round(10 * t) : 0, 0, 0); });
    EXPECT_NEAR(metric("jitter"), 0.01 / 2, 1e-12);
}

// A free fall of both masses keeps its energy; at half the speed it loses, at twice it gains.
TEST_F(LabRecording, energy_is_kept_in_free_fall) {
    const auto fall = [](double g) {
        return [g](double t, size_t i) {
            return Vec3(static_cast<double>(i), i ? -0.5 * g * t * t : 0, 0);
        };
    };
    fill(1, fall(10));
    EXPECT_NEAR(metric("energy_rise"), 0, 1e-6);
    recording_ = {};
    fill(1, fall(20));
    EXPECT_NEAR(metric("energy_rise"), 5.0 * 2 * 2 / (2.0 * 2), 10); // more than half of m g L
    EXPECT_GT(metric("energy_rise"), 0.5);
}

// A ball of 0.5 m comes along x to the middle of a hanging strand: hair must end ahead of it, and
// around it, not through it.
TEST_F(LabRecording, what_a_collider_came_through_is_not_ahead_of_it) {
    fill(1, [](double, size_t i) { return Vec3(0, -static_cast<double>(i), 0); });
    EXPECT_TRUE(std::isnan(metric("passed_through"))); // there is none
    lab::SceneCollider ball{common::smooth_collider(), {}};
    ball.shape.capsule.a[1] = ball.shape.capsule.b[1] = -1;
    ball.shape.capsule.radius_a = ball.shape.capsule.radius_b = 0.5f;
    scene_.colliders = {ball};
    EXPECT_TRUE(std::isnan(metric("passed_through"))); // it goes nowhere
    scene_.colliders =
        lab::read_scene(lab::Json{{"colliders",
                                   {{{"a", {-4, -1, 0}},
                                     {"radius_a", 0.5},
                                     {"motion", {{{"type", "move"}, {"velocity", {4, 0, 0}}}}}}}}},
                        {})
            .colliders;
    const auto ends = [&](double middle, double tip) {
        recording_ = {};
        fill(1, [=](double t, size_t i) {
            return Vec3(i == 1 ? middle * t : i == 2 ? tip * t : 0, -static_cast<double>(i), 0);
        });
        return metric("passed_through");
    };
    EXPECT_EQ(ends(1, 1), 0);     // around it
    EXPECT_EQ(ends(0.45, 1), 0);  // touches: less than a quarter of the radius
    EXPECT_EQ(ends(0.3, 1), 1);   // half way through
    EXPECT_EQ(ends(-1, -0.1), 1); // left behind
    EXPECT_EQ(ends(-0.4, 2), 1);  // an edge through it
}

// A level rod of two segments of 1 m, bent by 90 degrees at its middle.
lab::ElasticStrand rod(double EA, double EI) {
    return {{1, 1}, EA, EI, Vec3(1, 0, 0)};
}
const std::vector<Vec3> corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0)};

TEST(LabElastic, is_of_bending_alone_where_nothing_shears) {
    const double bend = 4 * (1 - std::cos(lab::pi / 4)); // 4 EI/lbar (1 - cos(angle/2))
    EXPECT_NEAR(least_elastic_energy(rod(1e9, 1), corner), bend, 1e-6);
    EXPECT_NEAR(least_elastic_energy(rod(3, 0), {Vec3(0, 0, 0), Vec3(1.1, 0, 0), Vec3(1.1, 1, 0)}),
                0.5 * 3 * 0.01, 1e-12);
    EXPECT_EQ(least_elastic_energy(rod(1, 1), {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}), 0);
}

// Soft against shear, segments lean off their edges: no turns in a plane have less, searched.
TEST(LabElastic, is_the_least_that_any_turns_give) {
    for (const double EA : {0.1, 1.0, 10.0}) {
        const lab::ElasticStrand s = rod(EA, 1);
        double least = 1e9;
        for (int i = -300; i <= 900; ++i)
            for (int k = -300; k <= 900; ++k) {
                const double a = i * lab::pi / 1800, b = k * lab::pi / 1800;
                const Vec3 t(std::cos(a), std::sin(a), 0), u(std::cos(b), std::sin(b), 0);
                least = std::min(least, 0.5 * EA *
                                                ((t - Vec3(1, 0, 0)).squaredNorm() +
                                                 (u - Vec3(0, 1, 0)).squaredNorm()) +
                                            8 * (1 - std::cos(a / 2)) +
                                            4 * (1 - std::cos((b - a) / 2)));
            }
        EXPECT_NEAR(least_elastic_energy(s, corner), least, 1e-4 * least) << "EA " << EA;
        EXPECT_LT(least, 0.99 * 4 * (1 - std::cos(lab::pi / 4)));
    }
}

TEST_F(LabRecording, nothing_is_said_of_what_is_not_finite) {
    fill(1, [](double, size_t i) { return Vec3(static_cast<double>(i), 0, 0); });
    recording_.nonfinite = 3;
    EXPECT_TRUE(std::isnan(metric("tilt")));
    EXPECT_EQ(metric("nonfinite"), 3);
}

TEST(LabVerdict, is_by_model_or_for_all) {
    lab::Measure measure;
    EXPECT_EQ(judge(measure, {lab::find_model("rod"), {}}, {1, ""}), lab::Verdict::none);
    measure.pass = {{"", 0.1}, {"rod", 0.01}};
    EXPECT_EQ(judge(measure, {lab::find_model("chain"), {}}, {-0.05, ""}), lab::Verdict::pass);
    EXPECT_EQ(judge(measure, {lab::find_model("rod"), {}}, {-0.05, ""}), lab::Verdict::fail);
    EXPECT_EQ(judge(measure, {lab::find_model("chain"), {}}, {NAN, ""}), lab::Verdict::fail);
    measure.at_least = 3;
    EXPECT_EQ(judge(measure, {lab::find_model("chain"), {}}, {2.9, ""}), lab::Verdict::fail);
    EXPECT_EQ(judge(measure, {lab::find_model("chain"), {}}, {3.1, ""}), lab::Verdict::pass);
}

// Errors of two levels in sixteen motions, by hand: a share of 0.5 tells that of the lesson; twice and four times
// as much as is told in two others, and one that hardly moves counts for nothing.
TEST(LabTransfer, is_the_ratio_of_what_is_told_to_what_was_found) {
    lab::levels::LevelRow row;
    row.listed = 0.25f;
    row.found.assign(16, {0.05, 0.1, 0.1}); // m
    row.found[5].error = 0.1005;
    row.found[6].error = 0.2;
    row.found[7] = {0.01, 1e-3, 1e-3};
    const auto found = lab::levels::transfer_of({row});
    const auto& listed = found[0];
    const auto& lesson = found[1];
    EXPECT_EQ(lesson.cases, 12u); // without those of the lesson, and the still one
    EXPECT_NEAR(lesson.within_2, 100.0 * 10 / 12, 1e-9);
    EXPECT_NEAR(lesson.under_2, 100.0 * 2 / 12, 1e-9);
    EXPECT_NEAR(lesson.under_3, 100.0 / 12, 1e-9);
    EXPECT_NEAR(lesson.mean, std::pow(0.5 / 1.005 * 0.25, 1.0 / 12), 1e-6);
    EXPECT_NEAR(listed.mean / lesson.mean, 0.5, 1e-6);
    EXPECT_NEAR(found[3].mean / lesson.mean, 1.5, 1e-6);
}

} // namespace
