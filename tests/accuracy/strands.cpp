// The strand models against converged solutions of the same discretisation (trajectories) and of
// the continuum (a cantilever at rest); tests/data/README.md says how these were computed. One
// strand of 1 m, level along +x, clamped or hinged at the origin.
#include "conformance/table.hpp"
#include "stability/one_strand.hpp"

#include <ostream>

namespace plait::test {
namespace {

constexpr float g = 9.81f; // m/s^2, the tables'
constexpr float line_density = 1e-3f;
const float unit_time = std::sqrt(1.0f / g); // s, sqrt(L/g)

struct Method {
    plait_model model;
    uint32_t iterations;
    uint32_t substeps;
    bool bdf2;
};

plait_sim_desc desc_of(const Method& method) {
    plait_sim_desc desc = plait_sim_desc_defaults();
    desc.model = method.model;
    desc.substeps = method.substeps;
    desc.params.iterations = method.iterations;
    desc.params.bdf2 = method.bdf2;
    desc.params.line_density = line_density;
    desc.params.gravity[1] = -g;
    return desc;
}

StrandShape level(uint32_t segments) {
    return {segments + 1, 1.0f, {1.0f, 0.0f, 0.0f}};
}

// Rows (t, vertex, x, y): rms distance in lengths over all samples of all vertices but the root.
double trajectory_error(OneStrand& strand, const std::string& table, uint32_t steps_per_sample) {
    const auto rows = read_table(table);
    EXPECT_GT(rows.size(), 900u) << table;
    double sum = 0.0, sample = 0.0;
    std::vector<std::array<float, 4>> x;
    for (const auto& row : rows) {
        if (row[0] > sample) {
            for (uint32_t i = 0; i < steps_per_sample; ++i)
                strand.step();
            sample = row[0];
            x = strand.read(PLAIT_FIELD_POSITION);
        }
        const auto& at = x[static_cast<size_t>(row[1])];
        sum += std::pow(double(at[0]) - row[2], 2) + std::pow(double(at[1]) - row[3], 2) +
               std::pow(double(at[2]), 2);
    }
    return std::sqrt(sum / static_cast<double>(rows.size()));
}

// Limp, equal masses, hinged, drag 2/s, 60 Hz, 2 s.
double chain_error(uint32_t substeps) {
    plait_sim_desc desc = desc_of({PLAIT_MODEL_CHAIN, 1, substeps, false});
    desc.params.drag = 2.0f;
    OneStrand strand(level(16), desc);
    return trajectory_error(strand, "chain_fall_N16_drag2.csv", 1);
}

TEST(ChainFall, one_solve_a_step) {
    EXPECT_LT(chain_error(1), 0.03); // row 4 asks for 0.02
}

TEST(ChainFall, four_substeps) {
    EXPECT_LT(chain_error(4), 0.014);
}

// Gamma = rho A g L^3 / EI; drag in 1/sqrt(L/g).
void make_rod(plait_sim_desc& desc, float gamma, float drag) {
    desc.step = 0.05f * unit_time; // 62.6 Hz
    desc.params.bend_stiffness = line_density * g / gamma;
    desc.params.drag = drag / unit_time;
}

// A clamped rod falls to rest: 30 sqrt(L/g), every fifth step compared.
struct RodCase {
    Method method;
    float gamma;
    double bar;
};

void PrintTo(const RodCase& c, std::ostream* out) {
    *out << "model " << c.method.model << ", gamma " << c.gamma;
}

class RodFall : public testing::TestWithParam<RodCase> {};

TEST_P(RodFall, stays_near_the_converged_trajectory) {
    const RodCase& c = GetParam();
    plait_sim_desc desc = desc_of(c.method);
    make_rod(desc, c.gamma, 2.0f);
    OneStrand strand(level(16), desc);
    const std::string gamma = std::to_string(std::lround(c.gamma));
    const double error = trajectory_error(strand, "rod_fall_gamma" + gamma + "_N16_drag2.csv", 5);
    EXPECT_LT(error, c.bar);
}

constexpr Method cosserat{PLAIT_MODEL_COSSERAT, 3, 1, false};
constexpr Method cosserat_fine{PLAIT_MODEL_COSSERAT, 2, 4, true};
constexpr Method rod{PLAIT_MODEL_ROD, 1, 1, false};
constexpr Method rod_fine{PLAIT_MODEL_ROD, 1, 2, true};

INSTANTIATE_TEST_SUITE_P(Cosserat, RodFall,
                         testing::Values(RodCase{cosserat, 1, 0.009}, RodCase{cosserat, 10, 0.009},
                                         RodCase{cosserat, 100, 0.013},
                                         RodCase{cosserat_fine, 1, 0.0012},
                                         RodCase{cosserat_fine, 10, 0.0055},
                                         RodCase{cosserat_fine, 100, 0.0095}));
INSTANTIATE_TEST_SUITE_P(Rod, RodFall,
                         testing::Values(RodCase{rod, 1, 0.002}, RodCase{rod, 10, 0.0025},
                                         RodCase{rod, 100, 0.0035}, RodCase{rod_fine, 1, 0.0007},
                                         RodCase{rod_fine, 10, 0.0012},
                                         RodCase{rod_fine, 100, 0.0018}));

// Where the tip comes to rest, and how far that is from the elastica's, in lengths.
double cantilever_error(plait_model model, uint32_t segments, float stretch_stiffness,
                        const std::vector<double>& row) {
    plait_sim_desc desc = desc_of({model, PLAIT_ITERATIONS_OF_MODEL, 1, false});
    make_rod(desc, static_cast<float>(row[0]), 2.4f);
    desc.params.stretch_stiffness = stretch_stiffness;
    OneStrand strand(level(segments), desc);
    strand.run(60 * double(unit_time));
    const auto tip = strand.tip();
    EXPECT_NEAR(tip[2], 0.0f, 1e-6f);
    return std::hypot(double(tip[0]) - row[1], double(tip[1]) - row[2]);
}

// EA that leaves nothing of stretch and shear, which the elastica has not.
constexpr float stiff = 1e5f * line_density * g; // N

// `floor` is what N segments of half a clamp and half a tip mass are away from the elastica.
TEST(Cantilever, rod_is_at_the_discretisation_floor) {
    for (const auto& row : read_table("cantilever.csv"))
        for (const auto& [segments, floor] : {std::pair{16u, row[3]}, std::pair{32u, row[4]}})
            EXPECT_LT(cantilever_error(PLAIT_MODEL_ROD, segments, stiff, row), 1.5 * floor)
                << "gamma " << row[0] << ", " << segments << " segments";
}

// With its default EA, which lets the strand shear by 5e-4 L; limp ones (gamma 1000) it has not
// settled after 60 sqrt(L/g).
TEST(Cantilever, cosserat_is_near_it) {
    const auto rows = read_table("cantilever.csv");
    const double bars[] = {0.0012, 0.004, 0.009, 0.026};
    ASSERT_EQ(rows.size(), std::size(bars));
    for (size_t i = 0; i < rows.size(); ++i)
        EXPECT_LT(cantilever_error(PLAIT_MODEL_COSSERAT, 16, 0.0f, rows[i]), bars[i])
            << "gamma " << rows[i][0];
}

} // namespace
} // namespace plait::test
