// The model `articulated` on the float64 reference: converged solutions of the same discretisation
// (tests/data/README.md), statics against an independent minimiser, lengths and energy. The kernel
// is held to the reference by the conformance tests.
#include "fall_table.hpp"
#include "stability/one_strand.hpp"

namespace plait::test {
namespace {

constexpr float g = 9.81f; // m/s^2, the tables'
constexpr float line_density = 1e-3f;
const float unit_time = std::sqrt(1.0f / g); // s, sqrt(L/g) of 1 m

plait_context* reference() {
    static const Context context = [] {
        plait_context_desc desc = plait_context_desc_defaults();
        desc.backend = "reference";
        return make_context(&desc);
    }();
    return context.get();
}

plait::SimDesc desc_of(uint32_t substeps) {
    plait::SimDesc desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.substeps = substeps;
    desc.material.line_density = line_density;
    desc.params.gravity[1] = -g;
    return desc;
}

// Gamma = rho A g L^3/EI, drag in 1/sqrt(L/g), steps of 0.05 sqrt(L/g).
plait::SimDesc rod_desc(uint32_t substeps, double gamma, float drag) {
    plait::SimDesc desc = desc_of(substeps);
    desc.step = 0.05f * unit_time;
    desc.material.bend_stiffness = static_cast<float>(double(line_density) * double(g) / gamma);
    desc.params.drag = drag / unit_time;
    return desc;
}

OneStrand level(uint32_t segments, const plait::SimDesc& desc) {
    return {straight({segments + 1, 1.0f, {1.0f, 0.0f, 0.0f}}), segments + 1, desc, reference()};
}

// The fall alone: the first 6 sqrt(L/g). The step before of a strand that is let go has stood, so
// that its weight comes a third of a step late: first order, whatever BDF2 is later.
TEST(ArticulatedFall, is_that_of_the_converged_rod) {
    for (const auto& [gamma, bar] :
         {std::pair{1, 0.002}, std::pair{10, 0.0045}, std::pair{100, 0.0065}}) {
        const std::string table = "rod_fall_gamma" + std::to_string(gamma) + "_N16_drag2.csv";
        OneStrand once = level(16, rod_desc(1, gamma, 2)), fine = level(16, rod_desc(4, gamma, 2));
        const double error = fall_error(once, table, 5, 6);
        EXPECT_LT(error, bar) << "gamma " << gamma;
        EXPECT_LT(fall_error(fine, table, 5, 6), error / 3.5) << "gamma " << gamma;
    }
}

// Two limp segments let go level: a double pendulum, the lower mass half the upper one, by
// Runge-Kutta 4. Angles from straight down.
class DoublePendulum {
  public:
    void run(double seconds) {
        constexpr int steps = 20000;
        const double h = seconds / steps;
        for (int i = 0; i < steps; ++i) {
            const State k1 = rate(at_), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)),
                        k4 = rate(moved(k3, h));
            for (size_t c = 0; c < 4; ++c)
                at_[c] += h / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
        }
    }
    std::array<double, 2> tip() const {
        return {l * (std::sin(at_[0]) + std::sin(at_[1])),
                -l * (std::cos(at_[0]) + std::cos(at_[1]))};
    }

  private:
    using State = std::array<double, 4>;                     // angles, rad; their rates
    static constexpr double l = 0.5, upper = 1, lower = 0.5; // m; masses in segments'

    State moved(const State& rate, double h) const {
        State s = at_;
        for (size_t c = 0; c < 4; ++c)
            s[c] += h * rate[c];
        return s;
    }
    static State rate(const State& s) {
        const double turn = s[0] - s[1], c = std::cos(turn), weight = double(g) / l;
        const double a =
            -lower * std::sin(turn) * s[3] * s[3] - (upper + lower) * weight * std::sin(s[0]);
        const double b = std::sin(turn) * s[2] * s[2] - weight * std::sin(s[1]);
        const double first = (a - lower * c * b) / (upper + lower - lower * c * c);
        return {s[2], s[3], first, b - c * first};
    }

    State at_ = {3.14159265358979 / 2, 3.14159265358979 / 2, 0, 0};
};

plait::SimDesc limp_desc(uint32_t substeps) {
    plait::SimDesc desc = desc_of(substeps);
    desc.material.bend_stiffness = 0;
    desc.material.stretch_stiffness = 1e-3f * line_density * g; // of which limp joints keep a share
    desc.params.drag = 0;
    return desc;
}

TEST(ArticulatedFall, is_that_of_a_double_pendulum) {
    constexpr double seconds = 0.8; // 48 steps
    DoublePendulum exact;
    exact.run(seconds);
    double before = 0.05; // m, with one substep
    for (const uint32_t substeps : {2u, 4u, 8u}) {
        OneStrand strand = level(2, limp_desc(substeps));
        strand.run(seconds);
        const auto tip = strand.tip();
        const double error =
            std::hypot(double(tip[0]) - exact.tip()[0], double(tip[1]) - exact.tip()[1]);
        EXPECT_LT(error, before / 2) << substeps << " substeps";
        EXPECT_NEAR(tip[2], 0, 1e-6);
        before = error;
    }
}

// At rest every joint holds the moment of the weight behind it: kb/2 sin(a/2), kb = 4 EI/lbar, a
// its angle, the first one half a segment long.
TEST(ArticulatedAtRest, joints_hold_the_weight) {
    constexpr uint32_t segments = 16;
    constexpr double l = 1.0 / segments;
    for (const double gamma : {1.0, 10.0, 100.0}) {
        const plait::SimDesc desc = rod_desc(1, gamma, 2.4f);
        OneStrand strand = level(segments, desc);
        strand.run(60 * double(unit_time));
        const auto x = strand.read(PLAIT_FIELD_POSITION);
        double angle_before = 0;
        for (uint32_t i = 0; i < segments; ++i) {
            const double angle =
                std::atan2(double(x[i + 1][1] - x[i][1]), double(x[i + 1][0] - x[i][0]));
            const double kb = 4 * double(desc.material.bend_stiffness) / (i == 0 ? l / 2 : l);
            double weight = 0;
            for (uint32_t j = i + 1; j <= segments; ++j)
                weight += double(line_density) * l * (j == segments ? 0.5 : 1) * double(g) *
                          double(x[j][0] - x[i][0]);
            const double whole = double(line_density * g) / 2; // of the level strand at its root
            EXPECT_NEAR(kb / 2 * std::sin((angle_before - angle) / 2), weight, 1e-4 * whole)
                << "gamma " << gamma << ", joint " << i;
            angle_before = angle;
        }
    }
}

// Shaken by 0.2 m at 4 Hz, which stretches `rod` by 15 % (tools/lab/baselines/rod.md).
TEST(Articulated, keeps_its_lengths) {
    plait::SimDesc desc = desc_of(1);
    desc.material.bend_stiffness = 1e-6f;
    OneStrand strand = level(16, desc);
    double worst = 0, fastest = 0;
    for (int i = 0; i < 120; ++i) {
        strand.move_head({0.2f * std::sin(0.4188790f * static_cast<float>(i)), 0, 0});
        strand.step();
        worst = std::max(worst, double(strand.measure().max_stretch));
        fastest = std::max(fastest, double(strand.measure().max_speed));
    }
    EXPECT_LT(worst, 1e-6); // the statistics' float32: what the positions are read as
    EXPECT_GT(fastest, 3);  // m/s: it was shaken
}

// Motion and height of a strand of equal segments with half a mass at the tip, and the bending of
// joints in one plane, J.
double energy_of(const OneStrand& strand, double EI) {
    const auto x = strand.read(PLAIT_FIELD_POSITION), v = strand.read(PLAIT_FIELD_VELOCITY);
    const size_t segments = x.size() - 1;
    const double l = 1.0 / double(segments);
    double sum = 0, before = 0;
    for (size_t i = 1; i <= segments; ++i) {
        const double m = double(line_density) * l * (i == segments ? 0.5 : 1);
        const double speed = double(std::hypot(v[i][0], v[i][1], v[i][2]));
        const double angle =
            std::atan2(double(x[i][1] - x[i - 1][1]), double(x[i][0] - x[i - 1][0]));
        sum += m * (speed * speed / 2 + double(g) * double(x[i][1])) +
               4 * EI / (i == 1 ? l / 2 : l) *
                   (1 - std::cos(std::remainder(angle - before, 6.283185307179586) / 2));
        before = angle;
    }
    return sum;
}

// A free fall without drag: never more than there was but for the budget's 1e-5 m g L a step and
// what BDF2's energy of pairs swings by.
TEST(Articulated, gains_no_energy) {
    const double weight = double(line_density * g); // times its length of 1 m
    for (const double gamma : {10.0, 100.0, 1000.0})
        for (const uint32_t substeps : {1u, 2u, 4u}) {
            const plait::SimDesc desc = rod_desc(substeps, gamma, 0);
            OneStrand strand = level(16, desc);
            const double EI = double(desc.material.bend_stiffness), begin = energy_of(strand, EI);
            double most = -1;
            for (int i = 0; i < 200; ++i) {
                strand.step();
                most = std::max(most, energy_of(strand, EI) - begin);
            }
            EXPECT_LT(most, 0.05 * weight) << "gamma " << gamma << ", " << substeps << " substeps";
            EXPECT_GT(most, -0.2 * weight) << "nothing may be lost in the first steps";
        }
}

// Groomed in balance it stays where it is, to the lengths of float32.
TEST(Articulated, starts_sag_free) {
    plait::SimDesc desc = rod_desc(1, 10, 2);
    desc.sag_free = PLAIT_SAG_FREE_STIFFEN;
    OneStrand strand = level(16, desc);
    EXPECT_LT(strand.describe().sag_residual, 1e-11);
    strand.run(5);
    const auto x = strand.read(PLAIT_FIELD_POSITION);
    for (size_t i = 0; i < x.size(); ++i) {
        EXPECT_NEAR(x[i][0], static_cast<float>(i) / 16, 1e-5f);
        EXPECT_NEAR(x[i][1], 0, 1e-5f);
    }
    EXPECT_EQ(strand.describe().sag_unstable, 0u);
}

} // namespace
} // namespace plait::test
