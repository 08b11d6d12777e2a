// Hair in motion: what the metrics of it say where the answer is known.
#include "accuracy/rows.hpp"
#include "common/json_reader.hpp"
#include "metrics/input.hpp"
#include "metrics/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

using lab::Json;
using lab::Vec3;

namespace {

const std::string scenes = PLAIT_SCENES;

lab::Value of(const lab::Scene& scene, const char* model, const lab::Setting& setting,
              const char* metric, double from = 0) {
    static lab::Contexts float64("reference", "");
    lab::Measure measure = lab::measure_of(metric);
    measure.from = from * scene.unit_time;
    const lab::Method method{lab::find_model(model), setting};
    return evaluate(scene, method, record(float64, scene, method), measure);
}

// Linear theory and a converged run know nothing of each other. Roots are straight within a step:
// so steps are fine.
double worst_of(const char* metric, const Json& overrides) {
    Json all{{"strand", {{"segments", 8}}}, {"rate", 200}};
    all.merge_patch(overrides);
    const lab::Scene scene = lab::read_scene(scenes + "/drive.json", all);
    return std::abs(of(scene, "rod", {4, 2, true}, metric, 6).value);
}

TEST(LabDrive, is_what_a_converged_rod_does) {
    for (const int gamma : {10, 1000}) {
        const Json hair{{"material", {{"gamma", gamma}}}};
        EXPECT_LT(worst_of("drive_amplitude", hair), 0.03) << gamma;
        EXPECT_LT(worst_of("drive_phase", hair), 1.5) << gamma;
    }
    const Json limp = Json::parse(R"({"material": {"gamma": "limp"}, "motion": [
        {"type": "sine", "amplitude": 0.002, "frequency": 1},
        {"type": "sine", "amplitude": 0.002, "frequency": 2, "phase": 60}]})");
    EXPECT_LT(worst_of("drive_amplitude", limp), 0.01);
    EXPECT_LT(worst_of("drive_phase", limp), 1);
}

// Backward Euler damps: less at resonance, and late or early. A metric that sees nothing would pass
// it.
TEST(LabDrive, sees_what_damps) {
    const lab::Scene scene =
        lab::read_scene(scenes + "/drive.json", {{"strand", {{"segments", 8}}}, {"rate", 20}});
    EXPECT_LT(of(scene, "rod", {1, 2, false}, "drive_amplitude", 6).value, -0.15);
    EXPECT_GT(std::abs(of(scene, "rod", {1, 2, false}, "drive_phase", 6).value), 10);
}

TEST(LabDrive, is_of_roots_that_sway_level_as_sines) {
    const lab::Setting coarse{1, 1, false};
    for (
        const char* motion :
        {R"([])", R"([{"type": "move", "velocity": [1, 0, 0]}])",
         R"([{"type": "sine", "direction": [0, 1, 0], "amplitude": 0.01, "frequency": 2}])",
         R"([{"type": "sine", "direction": [1, 0, 0], "amplitude": 0.01, "frequency": 2, "to": 1}])",
         R"([{"type": "sine", "direction": [1, 0, 0], "amplitude": 0.01, "frequency": 2},
              {"type": "sine", "direction": [0, 0, 1], "amplitude": 0.01, "frequency": 1}])"}) {
        const lab::Scene scene = lab::read_scene(
            Json{{"strand", {{"segments", 4}}}, {"duration", 2}, {"motion", Json::parse(motion)}},
            {});
        EXPECT_TRUE(std::isnan(of(scene, "rod", coarse, "drive_phase").value)) << motion;
    }
}

// Two strands on a head that turns and shakes.
lab::Scene shaken(const Json& overrides = Json::object()) {
    Json scene = Json::parse(R"({
        "strands": [{"segments": 6, "length": 0.2, "direction": [0, -1, 0], "gamma": 100},
                    {"segments": 6, "length": 0.1, "root": [0.05, 0, 0], "gamma": 5}],
        "drag": 2, "settle": 1, "duration": 1, "reference": {"converged": "rod", "substeps": 8},
        "motion": [{"type": "turn", "degrees": 30, "frequency": 1},
                   {"type": "sine", "acceleration_g": 0.5, "frequency": 2, "phase": 90}]})");
    scene.merge_patch(overrides);
    return lab::read_scene(scene, {});
}

// The reference's own mean in the head's frame is off by the swing itself.
TEST(LabSwingError, is_one_of_hair_that_stands_still) {
    const lab::Scene scene = shaken();
    const lab::Recording& reference = converged_run(scene, *scene.reference);
    lab::Recording still = reference;
    for (size_t s = 0; s < 2; ++s)
        for (size_t i = 1; i <= 6; ++i) {
            Vec3 mean = Vec3::Zero();
            for (const lab::Frame& frame : reference.frames)
                mean += frame.root.q.conjugate() * (frame.x[s][i] - frame.x[s][0]) /
                        static_cast<double>(reference.frames.size());
            for (lab::Frame& frame : still.frames)
                frame.x[s][i] = frame.x[s][0] + frame.root.q * mean;
        }
    const lab::Method rod{lab::find_model("rod"), {8, 2, true}};
    const auto value = [&](const lab::Recording& recording, const char* metric) {
        return evaluate(scene, rod, recording, lab::measure_of(metric)).value;
    };
    EXPECT_NEAR(value(still, "swing_error"), 1, 1e-9);
    EXPECT_NEAR(value(still, "swing_error_p90"), 1, 1e-9);
    EXPECT_EQ(value(reference, "swing_error"), 0);
    EXPECT_GT(value(reference, "swing_least"), 0.005);

    for (lab::Frame& frame : still.frames) // the second strand as it should be
        frame.x[1] = reference.frames[static_cast<size_t>(&frame - still.frames.data())].x[1];
    lab::Measure of_one = lab::measure_of("swing_error_strand");
    EXPECT_NEAR(evaluate(scene, rod, still, of_one).value, 1, 1e-9);
    of_one.strand = 1;
    EXPECT_EQ(evaluate(scene, rod, still, of_one).value, 0);
}

TEST(LabSwingError, falls_with_substeps) {
    const lab::Scene scene = shaken();
    const double one = of(scene, "rod", {1, 2, true}, "swing_error").value;
    const double four = of(scene, "rod", {4, 2, true}, "swing_error").value;
    EXPECT_GT(one, 0.01);
    EXPECT_LT(four, 0.4 * one);
    EXPECT_LE(one, of(scene, "rod", {1, 2, true}, "swing_error_p90").value);
}

TEST(LabSwingError, needs_a_converged_run) {
    EXPECT_TRUE(std::isnan(
        of(shaken({{"reference", nullptr}}), "rod", {1, 1, false}, "swing_error").value));
}

// Row 29c has to see a default that no longer swings: cosserat, whose sweeps let a segment turn by
// what it stretches alone, is off by the swing itself, and the strands do swing.
TEST(LabSwingError, in_short_tells_what_swings_from_what_does_not) {
    const lab::Scene scene = lab::read_scene(scenes + "/motion_short.json", Json::object());
    EXPECT_LT(of(scene, "articulated", {1, 1, true}, "swing_error").value, 0.2);
    EXPECT_GT(of(scene, "cosserat", {1, 3, false}, "swing_error").value, 0.6);
    EXPECT_GT(of(scene, "articulated", {1, 1, true}, "swing_least").value, 0.02) << "L, rms";
}

// Each strand has the stiffness of its own gamma: alone, it moves as it does beside others.
TEST(LabStrands, may_differ_in_stiffness) {
    const lab::Scene both = shaken();
    Json alone{
        {"strands",
         Json::array({Json::parse(R"({"segments": 6, "length": 0.1, "root": [0.05, 0, 0]})")})},
        {"material", {{"gamma", 5}}}};
    const lab::Scene one = shaken(alone);
    EXPECT_NEAR(both.bend_stiffness(both.strands[1]), one.material.bend_stiffness, 1e-12);
    lab::Contexts float64("reference", "");
    const lab::Method rod{lab::find_model("rod"), {1, 2, false}};
    const lab::Recording a = record(float64, both, rod), b = record(float64, one, rod);
    EXPECT_LT((a.frames.back().x[1].back() - b.frames.back().x[0].back()).norm(), 1e-6);
    EXPECT_THROW(shaken({{"material", {{"gamma", "limp"}}}}), lab::Failure);
}

// Whatever share of its mass is at its tip.
TEST(LabOneSegment, is_a_pendulum) {
    for (const bool half_tip : {false, true}) {
        const lab::HangingChain chain{{0.3}, 1, half_tip, 0};
        EXPECT_NEAR(chain.frequencies(9.81)[0], std::sqrt(9.81 / 0.3), 1e-12);
    }
    const lab::Scene scene = lab::read_scene(scenes + "/swing_limp.json",
                                             {{"strand", {{"segments", 1}}}, {"duration", 4}});
    for (const char* model : {"chain", "rod"})
        EXPECT_NEAR(of(scene, model, {8, 2, true}, "frequency_error").value, 0, 1e-3) << model;
    EXPECT_NEAR(of(scene, "articulated", {8, 2, true}, "frequency_error").value, 0, 3e-3);
    EXPECT_TRUE(std::isnan(of(scene, "tressfx", {1, 2, false}, "frequency_error").value));
}

TEST(LabScenes, may_count_time_in_swings) {
    const lab::Scene scene = lab::read_scene(Json{{"strand", {{"length", 0.25}}},
                                                  {"material", {{"gamma", 100}}},
                                                  {"time_unit", "swing"},
                                                  {"duration", 2}},
                                             {});
    const double w1 = 1.28687415686 * std::sqrt(lab::standard_gravity / 0.25); // by collocation
    EXPECT_NEAR(scene.unit_time, 2 * lab::pi / w1, 1e-3 * scene.unit_time);
    EXPECT_NEAR(scene.duration, 2 * scene.unit_time, 1e-12);
    EXPECT_NEAR(scene.rate, 60, 1e-9);
}

TEST(LabMarks, may_ask_more_of_settings_for_quality) {
    lab::Measure measure;
    measure.pass = {{"", 0.2}, {"quality", 0.1}, {"chain", 3}};
    const lab::Model &rod = *lab::find_model("rod"), &chain = *lab::find_model("chain");
    EXPECT_EQ(*mark_of(measure, {&rod, rod.settings.front()}), 0.2);
    EXPECT_EQ(*mark_of(measure, {&rod, *rod.quality}), 0.1);
    EXPECT_EQ(*mark_of(measure, {&chain, *chain.quality}), 3);
    EXPECT_EQ(mark_of(lab::Measure{}, {&rod, *rod.quality}), nullptr);
}

} // namespace
