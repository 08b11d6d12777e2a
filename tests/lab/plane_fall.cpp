// Falls in a plane by Lagrange's equations: against the tables, which were made otherwise, and
// against the models, which converge to them with masses and joints of their own.
#include "references/plane_fall.hpp"
#include "common/json_reader.hpp"
#include "metrics/metrics.hpp"
#include "references/modes.hpp"
#include "references/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

using lab::Json;

namespace {

constexpr uint32_t segments = 16;

lab::PlaneFall level(bool half_tip, double gamma) {
    lab::PlaneFall strand;
    strand.lengths.assign(segments, 1.0 / segments);
    strand.masses = lab::HangingChain{strand.lengths, 1, half_tip, 0}.masses();
    strand.angles.assign(segments, 0);
    strand.gravity = 9.81;
    strand.bend_stiffness = gamma > 0 ? strand.gravity / gamma : 0;
    return strand;
}

// The farthest any vertex of the table is from the fall; its times are in `unit` s.
double farthest(const lab::PlaneFall& strand, const char* file, double rate, double end,
                double unit = 1) {
    const lab::Table& table = lab::load_table(file);
    const auto way =
        fall_in_plane(strand, static_cast<uint32_t>(std::lround(end * rate)), unit / rate);
    double worst = 0;
    size_t compared = 0;
    for (const auto& row : table.rows) {
        if (row[0] > end + 1e-6)
            continue;
        const auto& at = way.at(static_cast<size_t>(std::lround(row[0] * rate)));
        const Eigen::Vector2d expected(row[table.column("x")], row[table.column("y")]);
        worst = std::max(worst, (at.at(static_cast<size_t>(row[1])) - expected).norm());
        ++compared;
    }
    EXPECT_GT(compared, 400u);
    return worst;
}

// Quad precision and SHAKE. 1e-7 is how exactly the table's times are written, times the speed.
TEST(LabPlaneFall, is_the_table_of_chains) {
    lab::PlaneFall chain = level(false, 0);
    EXPECT_LT(farthest(chain, "chain_fall_N16_undamped.csv", 60, 0.5), 5e-6);
    chain.drag = 2;
    EXPECT_LT(farthest(chain, "chain_fall_N16_drag2.csv", 60, 2), 5e-6);
    chain.masses.back() *= 0.5; // would be seen
    EXPECT_GT(farthest(chain, "chain_fall_N16_drag2.csv", 60, 2), 1e-3);
}

TEST(LabPlaneFall, is_the_table_of_rods) {
    const double unit = 1 / std::sqrt(9.81);
    for (const auto& [gamma, file] : {std::pair{1.0, "rod_fall_gamma1_N16_drag2.csv"},
                                      {10.0, "rod_fall_gamma10_N16_drag2.csv"},
                                      {100.0, "rod_fall_gamma100_N16_drag2.csv"}}) {
        lab::PlaneFall rod = level(true, gamma);
        rod.drag = 2 / unit;
        rod.law = lab::JointLaw::angle; // the table's
        EXPECT_LT(farthest(rod, file, 4, 10, unit), 1e-6) << file;
        rod.law = lab::JointLaw::cosserat; // the models': seen, and far below any mark
        const double apart = farthest(rod, file, 4, 10, unit);
        EXPECT_GT(apart, 4e-6) << file;
        EXPECT_LT(apart, 1e-3) << file;
    }
}

// As many steps as it takes by itself are enough: with more it is where it was.
TEST(LabPlaneFall, is_converged) {
    lab::PlaneFall rod = level(true, 10);
    const auto once = fall_in_plane(rod, 20, 0.05);
    const auto finer = fall_in_plane(rod, 20, 0.05, 400);
    for (size_t k = 0; k < once.size(); ++k)
        for (size_t i = 0; i < once[k].size(); ++i)
            EXPECT_LT((once[k][i] - finer[k][i]).norm(), 2e-6);
}

lab::Value error_of(const char* model, const lab::Setting& setting,
                    const Json& overrides = Json::object()) {
    static lab::Contexts contexts("", "");
    Json scene{{"strand", {{"segments", segments}, {"length", 1}}},
               {"material", {{"line_density", 1e-3}, {"gamma", "limp"}}},
               {"gravity", {0, -9.81, 0}},
               {"drag", 2},
               {"duration", 1},
               {"reference", {{"plane", true}}}};
    scene.merge_patch(overrides);
    const lab::Scene read = lab::read_scene(scene, lab::Origin{});
    const lab::Method method{lab::find_model(model), setting};
    return evaluate(read, method, record(contexts, read, method), lab::measure_of("rms_error"));
}

TEST(LabPlaneFall, is_what_the_models_converge_to) {
    EXPECT_LT(error_of("articulated", {64, 2, true}).value, 3e-3);
    EXPECT_LT(error_of("chain", {16, 1, true}).value, 3e-3); // with more, rounding
    EXPECT_LT(error_of("rod", {64, 2, true}).value, 3e-3);
    EXPECT_LT(error_of("rod", {64, 2, true}, {{"material", {{"gamma", 20}}}}).value, 1e-3);
}

// 7e-4 is what 1 % of stretch at 10 g makes.
TEST(LabPlaneFall, is_what_limp_baselines_converge_to) {
    const std::pair<const char*, lab::Setting> limp[] = {{"explicit_euler_limp", {256, 1, false}},
                                                         {"rk2_limp", {128, 1, false}},
                                                         {"rk4_limp", {32, 1, false}},
                                                         {"verlet_limp", {32, 1, false}}};
    for (const auto& [model, setting] : limp)
        EXPECT_LT(error_of(model, setting).value, 1e-3) << model;
    EXPECT_LT(error_of("pbd", {64, 1, false}).value, 2.5e-3); // first order in the step
    EXPECT_LT(error_of("pbd", {128, 1, false}).value, 1.8e-3);
}

TEST(LabPlaneFall, is_of_strands_that_fall_in_a_plane) {
    const lab::Setting coarse{1, 1, false};
    EXPECT_FALSE(std::isnan(error_of("rod", coarse).value));
    for (const Json& other :
         {Json{{"settle", 0.1}}, Json{{"motion", {{{"type", "move"}, {"velocity", {1, 0, 0}}}}}},
          Json{{"colliders", {{{"a", {0, -1, 0}}, {"radius_a", 0.1}}}}},
          Json{{"strand", {{"curvature", 6}, {"torsion", 3}}}}})
        EXPECT_TRUE(std::isnan(error_of("rod", coarse, other).value)) << other;
}

} // namespace
