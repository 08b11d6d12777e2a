// Hair with curls: a hanging helix against the Kirchhoff rod, its fall against the converged
// solution of the same discretisation; tests/data/README.md says how these were computed. 1 m of
// arc, three turns, z up, twist stiffness GJ = 0.6897 EI.
#include "fall_table.hpp"
#include "stability/one_strand.hpp"

#include <numbers>

namespace plait::test {
namespace {

constexpr float g = 9.81f;            // m/s^2
constexpr float line_density = 1e-3f; // kg/m
constexpr float twist_ratio = 0.689655172414f;
const float unit_time = std::sqrt(1.0f / g); // s, sqrt(L/g)

// Vertices of `segments` equal edges, each turned by the same rotation against the one before.
std::vector<Vec3> helix(uint32_t segments) {
    constexpr double rise = -0.287347885566; // of the whole helix
    const double turn = 6 * std::numbers::pi / segments, dz = rise / segments;
    const double chord = std::sqrt(1.0 / segments / segments - dz * dz);
    std::vector<Vec3> points{{0, 0, 0}};
    double x = 0, y = 0;
    for (uint32_t i = 0; i < segments; ++i) {
        const double heading = -std::numbers::pi / 2 - (i + 0.5) * turn;
        x += chord * std::cos(heading);
        y += chord * std::sin(heading);
        points.push_back(
            {static_cast<float>(x), static_cast<float>(y), static_cast<float>((i + 1) * dz)});
    }
    return points;
}

plait::SimDesc desc_of(float gamma, float drag) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.step = 0.05f * unit_time;
    plait_sim_params& p = desc.params;
    p.gravity[1] = 0.0f;
    p.gravity[2] = -g;
    desc.material.line_density = line_density;
    desc.material.bend_stiffness = line_density * g / gamma;
    desc.material.twist_stiffness = twist_ratio * desc.material.bend_stiffness;
    p.drag = drag / unit_time;
    return desc;
}

double distance(const std::array<float, 4>& a, const double* b) {
    return std::hypot(double(a[0]) - b[0], double(a[1]) - b[1], double(a[2]) - b[2]);
}

double hanging_error(const std::vector<double>& row, uint32_t segments, plait::SimDesc desc) {
    OneStrand strand(helix(segments), desc);
    strand.run(60 * double(unit_time));
    return distance(strand.tip(), &row[1]);
}

TEST(Helix, hangs_as_a_kirchhoff_rod) {
    const auto rows = read_table("helix_tip.csv");
    ASSERT_EQ(rows.size(), 3u);
    for (const auto& row : rows) {
        const double error = hanging_error(row, 32, desc_of(static_cast<float>(row[0]), 2.4f));
        std::printf("gamma %g: %.5f L\n", row[0], error);
        EXPECT_LT(error, 0.005) << "gamma " << row[0];
    }
}

// What leaving twist_stiffness out costs.
TEST(Helix, twist_as_stiff_as_bend_hangs_elsewhere) {
    const auto rows = read_table("helix_tip.csv");
    plait::SimDesc desc = desc_of(static_cast<float>(rows[2][0]), 2.4f);
    desc.material.twist_stiffness = 0.0f;
    EXPECT_GT(hanging_error(rows[2], 32, desc), 0.03);
}

struct FallCase {
    const char* name;
    uint32_t iterations, substeps, bdf2;
    double bar; // 0.03 is asked
};

class HelixFall : public testing::TestWithParam<FallCase> {};

// rms over all samples of all vertices but the root, in lengths.
TEST_P(HelixFall, stays_near_the_converged_trajectory) {
    plait::SimDesc desc = desc_of(100.0f, 2.0f);
    desc.params.iterations = GetParam().iterations;
    desc.params.bdf2 = GetParam().bdf2;
    desc.substeps = GetParam().substeps;
    OneStrand strand(helix(16), desc);
    const double error = fall_error(strand, "helix_fall_gamma100_N16_drag2.csv", 1);
    std::printf("%.5f L\n", error);
    EXPECT_LT(error, GetParam().bar);
}

INSTANTIATE_TEST_SUITE_P(Articulated, HelixFall,
                         testing::Values(FallCase{"one_step", 1, 1, 0, 0.008},
                                         FallCase{"two_steps", 2, 1, 0, 0.008},
                                         FallCase{"two_substeps_bdf2", 1, 2, 1, 0.006},
                                         FallCase{"four_substeps_bdf2", 2, 4, 1, 0.006}),
                         [](const auto& fall) { return std::string(fall.param.name); });

} // namespace
} // namespace plait::test
