// The bars: every row of the accuracy table that `articulated` can do, in its setting for real
// time and in the one for quality, on OpenCL and on the reference. A value has to meet its row's
// mark, or to be a known miss and no worse than recorded.
#include "accuracy/accuracy.hpp"
#include "common/params_reader.hpp"
#include "known_misses.hpp"
#include "run/report.hpp"

#include "simulate/support.hpp"

#include <cmath>
#include <ostream>
#include <set>

namespace lab {
namespace {

constexpr const char* table = PLAIT_SCENES "/accuracy.json";
// The library's own; of tressfx, which has no modulus, nothing is asked.
std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const Model& model : models())
        if (!model.baseline() && model.model != PLAIT_MODEL_TRESSFX)
            names.push_back(model.label);
    return names;
}

struct Case {
    std::string row, model, backend;
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << "row " << c.row << ", " << c.model << " on " << c.backend;
}

// Under three seconds on an idle core, on the reference under half a second: the sanitizers slow it
// most.
bool quick(const std::string& row, const std::string& backend) {
    static const std::set<std::string> long_on_opencl{"2",   "8",   "16a", "16b", "17b", "17c",
                                                      "18a", "18b", "20",  "29a", "29b", "30a",
                                                      "30b", "30c", "30d", "36",  "37a", "37b"};
    static const std::set<std::string> quick_on_reference{"4",   "5",  "6a",  "6b",  "7a",  "7b",
                                                          "9a",  "9b", "9c",  "10",  "12",  "17a",
                                                          "27a", "28", "29c", "34a", "34b", "34c"};
    return backend == "opencl" ? !long_on_opencl.contains(row) : quick_on_reference.contains(row);
}

std::vector<Case> cases(bool quick_ones) {
    std::vector<Case> all;
    for (const char* backend : {"opencl", "reference"})
        for (const Row& row : read_rows(table))
            for (const std::string& model : model_names())
                if (why_not(row, *find_model(model)).empty() &&
                    quick(row.id, backend) == quick_ones)
                    all.push_back({row.id, model, backend});
    return all;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return "row_" + info.param.row + "_" + info.param.model + "_" + info.param.backend;
}

const KnownMiss* find_miss(const Result& result) {
    for (const KnownMiss& miss : known_misses)
        if (miss.row == result.row && miss.variant == result.variant &&
            miss.method == result.model + " " + result.setting)
            return &miss;
    return nullptr;
}

// By how many times the value may be worse than recorded, besides what `rounding` allows where
// machines do not agree.
constexpr double leeway = 1.05;

// Of what misses its mark. A row without a largest value asks for a large one.
void expect_as_recorded(const Result& result, double recorded, double rounding) {
    if (std::isnan(result.value))
        ADD_FAILURE() << "has no number";
    else if (recorded == met)
        ADD_FAILURE() << "misses its mark" << (result.mark ? ", " + number(*result.mark) : "");
    else if (result.mark)
        EXPECT_LE(std::abs(result.value), recorded * leeway * rounding) << "worse than recorded";
    else
        EXPECT_GE(result.value, recorded / leeway / rounding) << "worse than recorded";
}

// What rounding may bring over the mark by luck has to pass clearly to be struck off.
bool stale(const Result& result, double recorded, double rounding) {
    if (recorded == met)
        return false;
    return !result.mark || std::abs(result.value) * rounding <= *result.mark;
}

void expect_met_or_known(const Result& result) {
    SCOPED_TRACE("row " + result.row + ", \"" + result.variant + "\", " + result.model + " " +
                 result.setting + ": " + number(result.value) + " " + result.unit + " " +
                 result.note);
    const KnownMiss* miss = find_miss(result);
    const double rounding = miss ? miss->rounding : 1;
    const double recorded = !miss                        ? met
                            : result.backend == "opencl" ? miss->opencl
                                                         : miss->reference;
    if (result.verdict == "pass")
        EXPECT_FALSE(stale(result, recorded, rounding)) << "passes now: take it off known_misses";
    else if (result.verdict == "MISS" || result.verdict == "FAILED")
        expect_as_recorded(result, recorded, rounding);
    else
        ADD_FAILURE() << "has no mark: \"" << result.verdict << '"';
}

class AccuracyBars : public TemporaryFolder, public testing::WithParamInterface<Case> {};

TEST_P(AccuracyBars, met) {
    AccuracyOptions options;
    options.table = table;
    options.rows = {GetParam().row};
    options.models = {GetParam().model};
    options.backend = GetParam().backend;
    options.out = path("bars");
    const AccuracyRun run = run_accuracy(options);
    EXPECT_EQ(run.methods.size(), 2u); // for real time and for quality
    ASSERT_GE(run.results.size(), run.methods.size());
    for (const Result& result : run.results)
        expect_met_or_known(result);
}

INSTANTIATE_TEST_SUITE_P(Quick, AccuracyBars, testing::ValuesIn(cases(true)), name_of);
INSTANTIATE_TEST_SUITE_P(Long, AccuracyBars, testing::ValuesIn(cases(false)), name_of);

// One that nothing measures would never be found stale.
TEST(KnownMisses, are_of_what_is_measured) {
    std::set<std::string> measured;
    for (const Row& row : read_rows(table))
        for (const Variant& variant : row.variants)
            for (const Method& method : methods_of(model_names(), false, false))
                if (why_not(row, *method.model).empty())
                    measured.insert(row.id + "|" + (row.spread ? "all" : variant.name) + "|" +
                                    method.label());
    for (const KnownMiss& miss : known_misses) {
        const std::string key = std::string(miss.row) + "|" + miss.variant + "|" + miss.method;
        EXPECT_TRUE(measured.contains(key)) << key;
        EXPECT_FALSE(miss.opencl == met && miss.reference == met) << key;
    }
}

} // namespace
} // namespace lab
