// Figures and pages: what is best at its cost, what fails, and that the lists of the repository
// hold.
#include "chart/chart.hpp"
#include "common/json_reader.hpp"
#include "page/page.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <sstream>

using lab::ChartPoint;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

// `ms` per 1/60 s and million vertices.
ChartPoint point(const char* model, double error, double ms, char letter = '\0') {
    ChartPoint p{{lab::find_model(model), {2, 3, true}}, 16, error, letter, {}};
    p.cost = {1000000, 21, ms / 1e3, 0, 1.0 / 60};
    return p;
}

TEST(LabChart, costs_are_of_a_sixtieth_second_and_a_million_vertices) {
    const lab::Cost cost{200000, 21, 0.01, 0.005, 1.0 / 120}; // 10 ms for 1/120 s
    EXPECT_NEAR(cost.ns_per_vertex(), 50, 1e-9);
    EXPECT_NEAR(cost.ms_per_frame(), 100, 1e-9);
    EXPECT_NEAR(cost.strands_at_60_hz(10), 1e3 / 60 / 100 * 1e5, 1e-6);
}

TEST(LabChart, the_front_is_what_nothing_beats) {
    lab::Chart chart;
    chart.points = {point("articulated", 0.01, 30),   point("articulated", 0.5, 10),
                    point("articulated", 0.02, 40),   point("articulated", 0.001, 90),
                    point("verlet", 3e-4, 95),        point("articulated", 1e-6, 5, 'E'),
                    point("articulated", NAN, 1, 'N')};
    const lab::Figure figure = lab::figure_of(chart, plait_device_info_defaults());
    const auto front = lab::front_of(figure);
    ASSERT_EQ(front.size(), 4u);
    EXPECT_EQ(front[0].error, 0.5);
    EXPECT_EQ(front[1].error, 0.01);
    EXPECT_EQ(front[2].error, 0.001);
    EXPECT_EQ(front[3].name, "verlet 2x3 BDF2");
    const std::string table = lab::winners_markdown(figure);
    EXPECT_THAT(table,
                HasSubstr("| 10 | articulated 2x3 BDF2 | 0.5 | articulated 2x3 BDF2 | 0.5 |\n"));
    EXPECT_THAT(table,
                HasSubstr("| 95 | verlet 2x3 BDF2 (baseline) | 0.0003 | articulated 2x3 BDF2 | "
                          "0.001 |\n"));
}

TEST(LabChart, who_is_left_out_is_said_once_a_reason) {
    EXPECT_THAT(lab::left_out_by_reason(
                    {"chain: does not bend", "rk2 64x1: costs 40 s", "pbd: does not bend"}),
                testing::ElementsAre("chain, pbd: does not bend", "rk2 64x1: costs 40 s"));
}

TEST(LabChart, failures_are_drawn_on_the_edge) {
    lab::Chart chart;
    chart.family.title = "A family";
    chart.floor = 0.0023;
    chart.points = {point("articulated", 0.01, 30), point("tressfx", NAN, 10, 'N')};
    const auto device = plait_device_info_defaults();
    const std::string script = lab::gnuplot_script(lab::figure_of(chart, device), "a/b");
    EXPECT_THAT(script, AllOf(HasSubstr("A family"), HasSubstr("2×3 b N"), HasSubstr("a/b.svg"),
                              HasSubstr("a/b.png"), HasSubstr("0.0023 with lines"),
                              HasSubstr("title 'articulated'"), HasSubstr("title 'tressfx'")));
    EXPECT_THAT(script, Not(HasSubstr("nan")));
    EXPECT_THAT(lab::chart_csv(chart, device), HasSubstr("articulated,0,16,2,3,1,0.01,.,30,51,"));
    EXPECT_THAT(lab::chart_csv(chart, device), HasSubstr("tressfx,0,16,2,3,1,nan,N,10,"));
}

TEST(LabChart, families_and_features_of_the_repository_are_valid) {
    const auto families = lab::read_families(PLAIT_SCENES "/charts.json");
    EXPECT_GE(families.size(), 5u);
    for (const lab::Family& family : families) {
        const lab::Scene scene = lab::read_scene(family.scene, family.overrides);
        EXPECT_TRUE(scene.reference.has_value()) << family.name;
    }
    const auto features = lab::read_features(PLAIT_SCENES "/features.json");
    EXPECT_GE(features.size(), 10u);
    for (const lab::Feature& feature : features) {
        EXPECT_NO_THROW(lab::read_scene(feature.scene, feature.with)) << feature.name;
        EXPECT_NO_THROW(lab::read_scene(feature.scene, feature.without)) << feature.name;
    }
}

class LabCharts : public TemporaryFolder {};

TEST_F(LabCharts, figures_may_share_a_list_of_methods) {
    const auto read = [&](const std::string& methods) {
        return lab::read_families(write(
            "c.json", R"({"methods": {"few": ["rod 4x2 BDF2", "verlet auto"], "none": "rod 1x1"},
            "charts": [{"name": "a", "scene": "s.json", "methods": )" +
                          methods + R"(}, {"name": "b", "scene": "s.json"}]})"));
    };
    const auto families = read(R"("few")");
    ASSERT_EQ(families[0].methods.size(), 2u);
    EXPECT_EQ(families[0].methods[0].label(), "rod 4x2 BDF2");
    EXPECT_EQ(families[0].methods[1].label(), "verlet auto");
    EXPECT_TRUE(families[1].methods.empty());
    EXPECT_EQ(read(R"(["rod 1x1"])")[0].methods.size(), 1u);
    for (const char* wrong : {R"("many")", R"("none")", "3", R"(["rod fast"])"})
        EXPECT_THROW(read(wrong), lab::Failure) << wrong;
}

TEST(LabPage, names_files_after_the_device) {
    EXPECT_EQ(lab::slug("pthread-Intel(R) Xeon(R) CPU"), "pthread-intel-r-xeon-r-cpu");
}

class LabPages : public TemporaryFolder {
  protected:
    static std::string text_of(const std::string& file) {
        std::ostringstream all;
        all << std::ifstream(file).rdbuf();
        return all.str();
    }
};

TEST_F(LabPages, keep_what_was_written_by_hand) {
    lab::Page page;
    page.accuracy.device = plait_device_info_defaults();
    std::strcpy(page.accuracy.device.name, "A Device");
    lab::Chart chart;
    chart.family.title = "A family";
    chart.points = {point("articulated", 0.01, 30), point("verlet", 0.001, 300)};
    page.charts.charts = {chart};
    lab::stability::Row row{{"map", "rod", "1x1", {60, 16, 10}, ""}, "10 g", {}};
    page.stability.rows = {row};
    row.outcome.grade = lab::stability::Grade::explosion;
    page.stability.rows.push_back(row);
    page.baselines.methods = {{lab::find_model("pbd"), {20, 1, false}}};
    const std::string file = path("lab-a-device.md");
    EXPECT_THAT(lab::write_page(path(""), page, path("")),
                testing::Contains(testing::EndsWith("lab-a-device.md")));
    std::string text = text_of(file);
    EXPECT_THAT(text, HasSubstr("### Baselines"));
    EXPECT_THAT(text, HasSubstr("| pbd 20x1 |\n"));
    EXPECT_THAT(text,
                HasSubstr("| 300 | verlet 2x3 BDF2 (baseline) | 0.001 | articulated 2x3 BDF2 |"));
    EXPECT_THAT(text, HasSubstr("| rod 1x1 | 2 | 0 | 1 | 0 | 0 | 0 | 0 | 1 | 2 | 1 |"));
    const std::string mark = lab::by_hand;
    text.insert(text.find(mark) + mark.size(), "\nOf my own.\n");
    write("lab-a-device.md", text);
    lab::write_page(path(""), page, path(""));
    EXPECT_THAT(text_of(file), HasSubstr(mark + "\nOf my own.\n"));
    EXPECT_EQ(text_of(file), text);
}

TEST_F(LabPages, have_one_picture) {
    lab::Page page;
    page.accuracy.device = plait_device_info_defaults();
    std::strcpy(page.accuracy.device.name, "A Device");
    for (const char* name : {"fall", "shake"}) {
        lab::Chart chart;
        chart.family.name = chart.family.title = name;
        chart.points = {point("rod", 0.01, 30)};
        page.charts.charts.push_back(chart);
        write(std::string(name) + ".svg", "a picture");
        write(std::string(name) + ".csv", "its points");
    }
    EXPECT_THAT(lab::write_page(path("page"), page, path("")),
                testing::ElementsAre(testing::EndsWith("page/lab-a-device.md"),
                                     testing::EndsWith("page/lab-a-device-shake.svg")));
    const std::string text = text_of(path("page/lab-a-device.md"));
    EXPECT_THAT(text, HasSubstr("![shake](lab-a-device-shake.svg)\n"));
    EXPECT_THAT(text, HasSubstr("### fall\n"));
}

class LabFeatures : public TemporaryFolder {};

// A strand with gravity and without: leaving it out moves the hair by its fall.
TEST_F(LabFeatures, say_what_leaving_out_moves) {
    write("s.json",
          R"({"title": "fall", "strand": {"segments": 3}, "duration": 0.1, "model": "chain"})");
    lab::FeatureOptions options;
    options.table = write("f.json", R"({"features": [{"feature": "weight", "scenes": ["s.json"],
        "without": {"gravity": [0, 0, 0]}}]})");
    options.backend = "reference";
    options.out = path("out");
    options.costs = {8, 3, false};
    const lab::FeatureRun run = lab::run_features(options);
    ASSERT_EQ(run.results.size(), 1u);
    EXPECT_GT(run.results[0].moved, 0.01);
    EXPECT_LT(run.results[0].moved, 1);
    EXPECT_GT(run.results[0].cost_with, 0);
    EXPECT_TRUE(std::isnan(run.results[0].error_with)); // the scene has no reference
    EXPECT_THAT(lab::features_markdown(run), HasSubstr("| weight | fall |"));
    EXPECT_THAT(lab::features_csv(run), HasSubstr("\nweight,fall,chain 1x1,"));
    EXPECT_EQ(nlohmann::json::parse(lab::features_json(run))["features"][0]["feature"], "weight");
}

TEST_F(LabFeatures, are_of_every_scene_they_name) {
    const auto table = [&](const char* scenes) {
        return write("f.json", std::string(R"({"features": [{"feature": "weight", "scenes": )") +
                                   scenes + "}]}");
    };
    const auto features = lab::read_features(table(R"(["s.json", "t.json"])"));
    ASSERT_EQ(features.size(), 2u);
    EXPECT_THAT(features[0].scene, testing::EndsWith("s.json"));
    EXPECT_THAT(features[1].scene, testing::EndsWith("t.json"));
    for (const char* wrong : {"[]", "\"s.json\"", "[3]"})
        EXPECT_THROW(lab::read_features(table(wrong)), lab::Failure) << wrong;
}

// Taken up, not measured again: times would differ. What was changed is; what was not asked for is
// not.
TEST_F(LabFeatures, are_taken_up_where_a_run_was_stopped) {
    const char* scene = R"({"strand": {"segments": 3}, "duration": 0.1, "drag": 1})";
    write("s.json", scene);
    write("t.json", scene);
    lab::FeatureOptions options;
    options.table = write("f.json", R"({"features": [
        {"feature": "weight", "scenes": ["s.json"], "with": {"model": "chain"},
         "without": {"model": "chain", "gravity": [0, 0, 0]}},
        {"feature": "air", "scenes": ["t.json"], "with": {"model": "rod"},
         "without": {"model": "rod", "drag": 0}}]})");
    options.backend = "reference";
    options.out = path("out");
    options.costs = {8, 3, false};
    const auto first = lab::run_features(options).results;
    ASSERT_EQ(first.size(), 2u);
    const auto again = lab::run_features(options).results;
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(again[i].cost_with / first[i].cost_with, 1, 1e-8);
        EXPECT_NEAR(again[i].moved / first[i].moved, 1, 1e-8);
    }
    options.costs.vertices = 12;
    EXPECT_NE(lab::run_features(options).results[0].cost_with, first[0].cost_with);
    write("s.json", R"({"strand": {"segments": 3}, "duration": 0.2, "drag": 1})");
    options.scenes = {"s"};
    const auto changed = lab::run_features(options).results;
    ASSERT_EQ(changed.size(), 1u);
    EXPECT_GT(changed[0].moved, 1.5 * first[0].moved);
    options.scenes = {};
    options.models = {"rod"};
    ASSERT_EQ(lab::run_features(options).results.size(), 1u);
    EXPECT_EQ(lab::run_features(options).results[0].feature, "air");
    options.scenes = {"u"};
    EXPECT_THROW(lab::run_features(options), lab::Failure);
}

} // namespace
