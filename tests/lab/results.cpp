// Results on disk, and a table that is taken up again.
#include "accuracy/accuracy.hpp"

#include "simulate/support.hpp"

#include <gmock/gmock.h>

#include <cmath>

using lab::Result;
using lab::Results;

namespace {

Result some(const std::string& row) {
    Result result;
    result.row = row;
    result.variant = "a, \"b\"";
    result.model = "rod";
    result.value = 0.125;
    result.mark = 0.2;
    result.verdict = "pass";
    return result;
}

class LabResults : public TemporaryFolder {};

TEST_F(LabResults, come_back_as_they_were) {
    {
        Results results(path("r.csv"), false);
        results.add(some("1"));
        Result failed = some("2");
        failed.value = NAN;
        failed.mark = {};
        results.add(failed);
    }
    Results again(path("r.csv"), false);
    EXPECT_EQ(again.taken_up(), 2u);
    const Result* one = again.find(some("1").key());
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(one->variant, "a, \"b\"");
    EXPECT_EQ(one->value, 0.125);
    EXPECT_EQ(one->mark, 0.2);
    EXPECT_TRUE(std::isnan(again.find(some("2").key())->value));
    EXPECT_EQ(again.find(some("3").key()), nullptr);
}

TEST_F(LabResults, a_line_cut_short_is_dropped) {
    { Results(path("r.csv"), false).add(some("1")); }
    std::ofstream(path("r.csv"), std::ios::app) << "2,half a li";
    EXPECT_EQ(Results(path("r.csv"), false).taken_up(), 1u);
    EXPECT_EQ(Results(path("r.csv"), false).taken_up(), 1u);
}

TEST_F(LabResults, fresh_ones_forget) {
    { Results(path("r.csv"), false).add(some("1")); }
    EXPECT_EQ(Results(path("r.csv"), true).taken_up(), 0u);
}

TEST_F(LabResults, of_another_program_are_refused) {
    write("r.csv", "other,columns\n1,2\n");
    EXPECT_THROW(Results(path("r.csv"), false), lab::Failure);
}

constexpr const char* table = R"({"rows": [
    {"row": "1", "title": "falls", "scene": "s.json", "measure": {"metric": "drop", "pass": 2},
     "vary": [{"name": "short", "set": {"duration": 0.1}}, {"name": "long", "set": {"duration": 0.2}}]},
    {"row": "2", "title": "twists", "scene": "s.json", "needs": ["twist"], "measure": {"metric": "drop"}}]})";

class LabAccuracy : public TemporaryFolder {
  protected:
    lab::AccuracyRun run(bool fresh = false) {
        write("s.json", R"({"strand": {"segments": 3}})");
        lab::AccuracyOptions options;
        options.table = write("rows.json", table);
        options.models = {"chain"};
        options.backend = "reference";
        options.out = path("out");
        options.fresh = fresh;
        return run_accuracy(options);
    }
};

TEST_F(LabAccuracy, takes_up_what_is_there) {
    const auto first = run();
    ASSERT_EQ(first.results.size(), 6u); // two settings of three cases
    EXPECT_EQ(first.results[0].verdict, "pass");
    EXPECT_GT(first.results[0].value, 0.0);
    EXPECT_GT(first.results[2].value, first.results[0].value); // it falls on
    EXPECT_EQ(first.results[4].verdict, "cannot");
    EXPECT_THAT(first.results[4].note, testing::HasSubstr("no twist"));

    const auto again = run();
    for (size_t i = 0; i < 4; ++i) { // the very same measurement, not another
        EXPECT_NEAR(again.results[i].seconds, first.results[i].seconds,
                    1e-8 * first.results[i].seconds);
        EXPECT_NEAR(again.results[i].value, first.results[i].value, 1e-8);
    }
}

TEST_F(LabAccuracy, what_a_model_cannot_do_says_why) {
    lab::AccuracyOptions options;
    write("s.json", R"({"strand": {"segments": 3}, "duration": 0.1})");
    options.table = write("rows.json", R"({"rows": [{"row": "1", "scene": "s.json",
        "measure": {"metric": "drop"}, "needs": ["bending"]}]})");
    options.models = {"pbd", "xpbd"};
    options.out = path("out");
    const auto results = run_accuracy(options).results;
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[0].verdict, "cannot");
    EXPECT_EQ(results[0].note, "does not bend");
    EXPECT_EQ(results[1].verdict, "");
    EXPECT_GT(results[1].value, 0.0);
}

// A chain falls as fast with thrice the mass, and four times as far in twice the time.
TEST_F(LabAccuracy, rows_may_be_over_what_the_model_has_elsewhere) {
    lab::AccuracyOptions options;
    write("s.json", R"({"strand": {"segments": 3}, "duration": 0.05, "rate": 240, "drag": 0})");
    options.table = write("rows.json", R"({"rows": [{"row": "1", "scene": "s.json",
        "measure": {"metric": "drop", "pass": 0.01}, "over": {"name": "here"}, "vary": [
        {"name": "heavy", "set": {"material": {"line_density": 1.5e-5}}},
        {"name": "long", "set": {"duration": 0.1}}]}]})");
    options.models = {"chain"};
    options.out = path("out");
    const auto results = run_accuracy(options).results;
    ASSERT_EQ(results.size(), 4u);
    EXPECT_NEAR(results[0].value, 0, 1e-5);
    EXPECT_EQ(results[0].verdict, "pass");
    EXPECT_NEAR(results[2].value, 3, 0.5);
    EXPECT_EQ(results[2].verdict, "MISS");
    write("s.json", R"({"strand": {"segments": 3}, "measure": []})");
    write("rows.json", R"({"rows": [{"row": "1", "scene": "s.json", "spread": true,
        "over": {"name": "here"}, "measure": {"pass": 1}}]})");
    EXPECT_THROW(run_accuracy(options), lab::Failure);
}

TEST_F(LabAccuracy, a_changed_scene_is_measured_again) {
    run();
    write("s.json", "{}");
    lab::AccuracyOptions options;
    options.table = path("rows.json");
    options.models = {"chain"};
    options.backend = "reference";
    options.out = path("out");
    write("s.json", R"({"strand": {"segments": 4}})");
    EXPECT_EQ(run_accuracy(options).results.size(), 6u);
    EXPECT_EQ(Results(path("out/accuracy.csv"), false).taken_up(), 8u);
}

TEST_F(LabAccuracy, names_the_nearest_row_and_model) {
    run();
    lab::AccuracyOptions options;
    options.table = path("rows.json");
    options.rows = {"11"};
    EXPECT_THROW(run_accuracy(options), lab::Failure);
    options.rows = {};
    options.models = {"chian"};
    EXPECT_THROW(run_accuracy(options), lab::Failure);
}

} // namespace
