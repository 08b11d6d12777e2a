// E_total: from the limit of many segments, at eighths of the length.
#include "references/continuum.hpp"
#include "chart/chart.hpp"
#include "common/json_reader.hpp"
#include "metrics/metrics.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

using lab::Json;
using testing::AllOf;
using testing::HasSubstr;

namespace {

class LabContinuum : public TemporaryFolder {
  protected:
    // A level clamped hair that falls.
    lab::Scene fall(uint32_t segments, uint32_t limit = 64) const {
        const Json overrides{{"strand", {{"segments", segments}}},
                             {"reference", {{"segments", limit}}}};
        return lab::read_scene(write("s.json", R"({"strand": {"length": 0.3},
            "material": {"gamma": 10}, "drag": 10, "duration": 0.15,
            "reference": {"converged": "rod"}})"),
                               overrides);
    }
    static lab::Value value(const lab::Scene& scene, const char* metric) {
        lab::Contexts float64("reference", "");
        const lab::Method rod{lab::find_model("rod"), {16, 2, true}};
        const lab::Recording recording = record(float64, scene, rod);
        return evaluate(scene, rod, recording, lab::measure_of(metric));
    }
};

// Half a joint at the root and half a mass at the tip: order 2.
TEST_F(LabContinuum, what_is_converged_in_time_falls_with_the_square_of_segments) {
    const double e8 = value(fall(8), "rms_error").value, e16 = value(fall(16), "rms_error").value,
                 e32 = value(fall(32), "rms_error").value;
    EXPECT_NEAR(e8 / e16, 4, 0.6) << e8 << " " << e16;
    EXPECT_NEAR(e16 / e32, 4, 0.6) << e16 << " " << e32;
}

// A limit from half as many segments is no farther from the better one than it says.
TEST_F(LabContinuum, its_error_is_not_larger_than_it_says) {
    const lab::Scene scene = fall(16, 32);
    const lab::Scene better = fall(16, 64);
    const lab::Continuum a = lab::continuum_of(scene, *scene.reference, 0);
    const lab::Continuum b = lab::continuum_of(better, *better.reference, 0);
    ASSERT_EQ(a.times.size(), 10u);
    double sum = 0;
    for (size_t k = 0; k < a.times.size(); ++k)
        for (size_t i = 0; i < lab::places; ++i)
            sum += (a.points[k][i] - b.points[k][i]).squaredNorm();
    const double apart = std::sqrt(sum / static_cast<double>(10 * lab::places)) / 0.3;
    EXPECT_GT(apart, 0);
    EXPECT_LE(apart, a.error);
    EXPECT_EQ(value(scene, "reference_error").value, a.error);
}

TEST_F(LabContinuum, needs_vertices_at_eighths) {
    EXPECT_THAT(value(fall(12, 32), "rms_error").note, HasSubstr("eighths"));
    EXPECT_THROW(fall(16, 24), lab::Failure); // half of them has none
}

lab::ChartPoint point(const char* model, uint32_t segments, double error, double ms) {
    lab::ChartPoint p{{lab::find_model(model), {2, 3, true}}, segments, error, '\0', {}};
    p.cost = {1000000, 21, ms / 1e3, 0, 1.0 / 60};
    return p;
}

TEST(LabFreeSegments, are_said_and_cost_by_the_strand) {
    lab::Chart chart;
    chart.family.segments = {8, 16};
    chart.floor = 3e-4;
    chart.points = {point("rod", 8, 0.1, 30), point("rod", 16, 0.01, 30),
                    point("rod", 16, 0.05, 60)};
    const auto device = plait_device_info_defaults();
    const lab::Figure figure = lab::figure_of(chart, device);
    ASSERT_EQ(figure.series.size(), 1u);
    EXPECT_EQ(figure.series[0].dots[1].name, "rod 2x3 BDF2, N 16");
    EXPECT_NEAR(figure.series[0].dots[0].cost, 27, 1e-9); // 100,000 strands of 9 vertices
    EXPECT_NEAR(figure.series[0].dots[1].cost, 51, 1e-9);
    const std::string script = lab::gnuplot_script(figure, "a/b");
    EXPECT_THAT(script, AllOf(HasSubstr("51 0.01\n"), HasSubstr("\"16: 2×3 b\"\n")));
    EXPECT_THAT(script, HasSubstr("100,000 strands"));
    EXPECT_THAT(script, HasSubstr("error of the reference"));
    EXPECT_THAT(script, HasSubstr("$m0o << EOD\n102 0.05")); // beaten by its own: a dot
    EXPECT_THAT(lab::chart_csv(chart, device), HasSubstr("rod,1,16,2,3,1,0.01,.,30,51,"));
}

class LabFreeFamily : public TemporaryFolder {};

// One figure made: who cannot is named, every other has each number of segments; taken up again.
TEST_F(LabFreeFamily, is_measured_and_names_who_cannot) {
    write("s.json", R"({"strand": {"length": 0.3}, "material": {"gamma": 10}, "duration": 0.05,
        "reference": {"converged": "rod", "segments": 32}})");
    lab::ChartOptions options;
    options.table = write("c.json", R"({"charts": [{"name": "f", "scene": "s.json",
        "segments": [8, 16], "needs": ["bending"], "methods": ["chain 1x1", "rod 16x2 BDF2"]}]})");
    options.backend = "reference";
    options.out = path("out");
    options.costs = {20, 3, false};
    const lab::ChartRun run = lab::run_charts(options);
    ASSERT_EQ(run.charts.size(), 1u);
    const lab::Chart& chart = run.charts[0];
    EXPECT_THAT(chart.left_out, testing::ElementsAre("chain: does not bend"));
    ASSERT_EQ(chart.points.size(), 2u);
    EXPECT_EQ(chart.points[0].segments, 8u);
    EXPECT_EQ(chart.points[1].segments, 16u);
    EXPECT_LT(chart.points[1].error, chart.points[0].error);
    EXPECT_GT(chart.floor, 0);
    EXPECT_EQ(lab::run_charts(options).charts[0].points[1].cost.wall, chart.points[1].cost.wall);
    write("c.json", R"({"charts": [{"name": "f", "scene": "s.json", "methods": ["rod fast"]}]})");
    EXPECT_THROW(lab::run_charts(options), lab::Failure);
    write("c.json", R"({"charts": [{"name": "f", "scene": "s.json", "segments": [8, 12]}]})");
    EXPECT_THROW(lab::run_charts(options), lab::Failure); // no vertices at eighths
}

} // namespace
