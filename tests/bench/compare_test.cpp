// Two runs of the benchmark beside each other: what is marked, and what is refused.
#include "compare.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

namespace bench {
namespace {

constexpr char copper[] = R"("device:0": "copper; Oxide")";

class Compare : public testing::Test {
  protected:
    void SetUp() override {
        const auto folder = std::filesystem::temp_directory_path() /
                            ("plait-" + std::to_string(std::random_device{}()));
        ASSERT_TRUE(std::filesystem::create_directory(folder));
        folder_ = folder.string();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ + "/" + name) << text;
        return folder_ + "/" + name;
    }
    // Rows as Google Benchmark writes them, with a mean that must not count.
    static std::string row(const std::string& name, const std::vector<double>& times,
                           const std::string& unit = "us") {
        std::string text;
        for (const double time : times)
            text += R"({"name": ")" + name + R"(", "run_name": ")" + name +
                    R"(", "run_type": "iteration", "real_time": )" + std::to_string(time) +
                    R"(, "time_unit": ")" + unit + "\"},\n";
        return text + R"({"name": ")" + name + R"(_mean", "run_name": ")" + name +
               R"(", "run_type": "aggregate", "real_time": 1e9, "time_unit": "us"})";
    }
    std::string run(const std::string& name, const std::string& rows,
                    const std::string& devices = copper) const {
        return write(name, "{\"context\": {" + devices + "}, \"benchmarks\": [" + rows + "]}");
    }
    // Of one row.
    ComparedRow compared(const std::vector<double>& before,
                         const std::vector<double>& after) const {
        const auto comparison = compare_runs(run("old.json", row("device:0/a/b", before)),
                                             run("new.json", row("device:0/a/b", after)));
        EXPECT_EQ(comparison.rows.size(), 1u);
        return comparison.rows.at(0);
    }
    static std::string refusal(const std::function<void()>& attempt) {
        try {
            attempt();
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "no refusal";
    }

    std::string folder_;
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(Compare, TakesMediansOfRepetitions) {
    const ComparedRow row = compared({30, 10, 20}, {60, 20, 40, 80});
    EXPECT_EQ(row.device, "copper; Oxide");
    EXPECT_EQ(row.row, "a/b");
    EXPECT_DOUBLE_EQ(row.before.median(), 20e-6);
    EXPECT_DOUBLE_EQ(row.after.median(), 50e-6);
    EXPECT_DOUBLE_EQ(row.ratio(), 2.5);
    EXPECT_DOUBLE_EQ(row.before.spread(), 1.0);
}

TEST_F(Compare, MarksWhatIsBeyondTheNoise) {
    EXPECT_EQ(compared({10, 11, 12}, {13, 14, 15}).verdict(0.05), Verdict::slower);
    EXPECT_EQ(compared({13, 14, 15}, {10, 11, 12}).verdict(0.05), Verdict::faster);
    EXPECT_EQ(compared({10, 11, 14}, {13, 14, 15}).verdict(0.05), Verdict::same) << "they overlap";
    EXPECT_EQ(compared({100, 100, 100}, {104, 104, 104}).verdict(0.05), Verdict::same) << "little";
    EXPECT_EQ(compared({100, 100, 100}, {104, 104, 104}).verdict(0.03), Verdict::slower);
    EXPECT_EQ(compared({10, 10}, {20, 20, 20}).verdict(0.05), Verdict::unknown) << "too few";
}

TEST_F(Compare, KnowsUnits) {
    const auto comparison = compare_runs(run("old.json", row("device:0/a", {1.5}, "ms")),
                                         run("new.json", row("device:0/a", {3000}, "us")));
    EXPECT_DOUBLE_EQ(comparison.rows.at(0).ratio(), 2);
}

TEST_F(Compare, TakesTheStagesOfAFeature) {
    const auto feature = [](double whole, double stage) {
        return R"({"name": "device:0/feature/mesh", "run_type": "iteration", "time_unit": "us", "real_time": )" +
               std::to_string(whole) + R"(, "us:skin": )" + std::to_string(stage) +
               R"(, "us:roots": 0})";
    };
    const auto comparison =
        compare_runs(run("old.json", feature(10, 2)), run("new.json", feature(10, 3)));
    ASSERT_EQ(comparison.rows.size(), 2u) << "roots took no time";
    EXPECT_EQ(comparison.rows[1].row, "feature/mesh/skin");
    EXPECT_DOUBLE_EQ(comparison.rows[1].ratio(), 1.5);
}

// A device keeps its rows where another driver changes its number.
TEST_F(Compare, GoesByTheDevicesName) {
    const auto comparison =
        compare_runs(run("old.json", row("device:0/a", {1})),
                     run("new.json", row("device:1/a", {2}) + "," + row("device:0/a", {5}),
                         R"("device:0": "tin; Oxide", "device:1": "copper; Oxide")"));
    ASSERT_EQ(comparison.rows.size(), 1u);
    EXPECT_DOUBLE_EQ(comparison.rows.at(0).ratio(), 2);
    ASSERT_EQ(comparison.only_after.size(), 1u);
    EXPECT_EQ(comparison.only_after[0], "tin; Oxide: a");
}

TEST_F(Compare, PrintsRowsAndEndsWell) {
    const auto before =
        run("old.json", row("device:0/wind", {10, 11, 12}) + "," + row("device:0/gone", {1}));
    const auto after = run("new.json", row("device:0/wind", {20, 21, 22}));
    std::ostringstream out;
    EXPECT_EQ(compare_command({before, after}, out), 0) << "speed is judged by people";
    EXPECT_SAYS(out.str(), "SLOWER  wind");
    EXPECT_SAYS(out.str(), "1.909");
    EXPECT_SAYS(out.str(), "1 rows: beyond the noise 0 faster, 1 slower");
    EXPECT_SAYS(out.str(), "1 rows only in the old run, the first: copper; Oxide: gone");
    std::ostringstream lax;
    EXPECT_EQ(compare_command({before, after, "--least=100"}, lax), 0);
    EXPECT_SAYS(lax.str(), "0 faster, 0 slower");
}

TEST_F(Compare, RefusesWhatIsNoRun) {
    const auto good = run("good.json", row("device:0/a", {1}));
    const auto refused = [&](const std::string& other) {
        return refusal([&] { compare_runs(good, other); });
    };
    EXPECT_SAYS(refused(folder_ + "/none.json"), "none.json: cannot be read");
    EXPECT_SAYS(refused(write("text.json", "faster")), "text.json: is not JSON: ");
    EXPECT_SAYS(refused(write("list.json", "[1]")), "list.json: is not of Google Benchmark's");
    EXPECT_SAYS(refused(run("empty.json", "")), "empty.json: has no row with a time");
    EXPECT_SAYS(refused(run("other.json", row("BM_sort", {1}))),
                "row \"BM_sort\" begins with no device: not a file of plait-bench");
    EXPECT_SAYS(refused(run("unknown.json", row("device:3/a", {1}))),
                "its context does not say what device:3 is");
    EXPECT_SAYS(refused(run("units.json", row("device:0/a", {1}, "h"))), "time_unit is \"h\"");
    EXPECT_SAYS(refused(run("zero.json", row("device:0/a", {0}))), "is not above 0");
}

TEST_F(Compare, RefusesWhatHasNothingInCommon) {
    const auto good = run("good.json", row("device:0/a", {1}));
    EXPECT_SAYS(refusal([&] {
                    compare_runs(good, run("tin.json", row("device:0/a", {1}),
                                           R"("device:0": "tin; Oxide")"));
                }),
                "no device is in both: " + good + " is of copper; Oxide; ");
    EXPECT_SAYS(refusal([&] { compare_runs(good, run("rows.json", row("device:0/b", {1}))); }),
                "no row is in both");
}

TEST_F(Compare, RefusesOtherSizes) {
    const auto small =
        run("small.json", row("device:0/a", {1}), std::string(copper) + R"(, "size": "4 strands")");
    const auto large =
        run("large.json", row("device:0/a", {1}), std::string(copper) + R"(, "size": "9 strands")");
    EXPECT_SAYS(refusal([&] { compare_runs(small, large); }),
                "the rows are of other sizes: " + small + " has 4 strands, " + large +
                    " has 9 strands");
}

TEST_F(Compare, RefusesWhatIsAskedBadly) {
    std::ostringstream out;
    EXPECT_SAYS(refusal([&] { compare_command({"one.json"}, out); }),
                "takes two files, OLD.json and NEW.json; here are 1");
    EXPECT_SAYS(refusal([&] {
                    compare_command({"--lest=1", "a", "b"}, out);
                }),
                "there is no option --lest=1");
    EXPECT_SAYS(refusal([&] {
                    compare_command({"--least=much", "a", "b"}, out);
                }),
                "--least=much: not a number from 0 to 1000");
}

} // namespace
} // namespace bench
