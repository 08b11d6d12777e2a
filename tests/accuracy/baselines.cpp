// The baselines of tools/lab, so that what plait is compared with is no strawman: each comes to
// the right answer with many substeps, and the explicit ones hold and fail where theory says.
#include "fall_table.hpp"
#include "lab/baselines/source.hpp"
#include "stability/one_strand.hpp"

#include <map>
#include <ostream>
#include <string>

namespace plait::test {
namespace {

constexpr float g = 9.81f;                   // m/s^2
constexpr float line_density = 1e-3f;        // kg/m
const float unit_time = std::sqrt(1.0f / g); // s, sqrt(L/g) of a strand of 1 m

// A context on PoCL in which a baseline stands in for the stage `stage`.
plait_context* context_of(const std::string& baseline) {
    static std::map<std::string, Context> made;
    Context& context = made[baseline];
    if (!context) {
        const size_t suffix = baseline.find("_limp");
        const std::string file = baseline.substr(0, suffix) + ".cl";
        const std::string text =
            (suffix == baseline.npos ? "" : "#define SPRING_LIMP\n") +
            ::lab::baseline_source(PLAIT_SOURCE_DIR "/tools/lab/baselines", file);
        const plait_stage_source source{"articulated", text.c_str(), baseline.c_str()};
        plait_context_desc desc = plait_context_desc_defaults();
        desc.backend = "opencl";
        desc.stage_sources = &source;
        desc.stage_source_count = 1;
        context = make_context(&desc);
    }
    return context.get();
}

plait::SimDesc desc_of(uint32_t substeps, uint32_t iterations = 1) {
    plait::SimDesc desc;
    desc.substeps = substeps;
    desc.params.iterations = iterations;
    desc.params.bdf2 = 0; // only rod has it
    desc.material.line_density = line_density;
    desc.params.gravity[1] = -g;
    return desc;
}

OneStrand strand_of(const std::string& baseline, const plait::SimDesc& desc, Vec3 direction,
                    uint32_t segments = 16) {
    const auto points = straight({segments + 1, 1.0f, direction});
    return OneStrand(points, segments + 1, desc, context_of(baseline));
}

constexpr Vec3 level{1.0f, 0.0f, 0.0f}, hanging{0.0f, -1.0f, 0.0f};

// Gamma = rho A g L^3 / EI.
void make_rod_material(plait::SimDesc& desc, float gamma) {
    desc.material.bend_stiffness = line_density * g / gamma;
}

// With drag in 1/sqrt(L/g), and steps of a fifth of the tables'.
void make_rod(plait::SimDesc& desc, float gamma, float drag) {
    make_rod_material(desc, gamma);
    desc.step = 0.05f * unit_time;
    desc.params.drag = drag / unit_time;
}

// ---- the right answer with many substeps --------------------------------------------------------

struct Fall {
    const char* baseline;
    float gamma;
    uint32_t substeps;
    double bar; // rms distance from the converged strand, lengths
};

void PrintTo(const Fall& fall, std::ostream* out) {
    *out << fall.baseline << ", gamma " << fall.gamma << ", " << fall.substeps << " substeps";
}

class BaselineFall : public testing::TestWithParam<Fall> {};

TEST_P(BaselineFall, converges_to_the_true_trajectory) {
    const Fall& fall = GetParam();
    plait::SimDesc desc = desc_of(fall.substeps);
    make_rod(desc, fall.gamma, 2.0f);
    OneStrand strand = strand_of(fall.baseline, desc, level);
    const std::string name = "rod_fall_gamma" + std::to_string(std::lround(fall.gamma));
    EXPECT_LT(fall_error(strand, name + "_N16_drag2.csv", 5), fall.bar);
}

// What the table's inextensible rod is away. Limp ones: tests/lab/plane_fall.cpp.
INSTANTIATE_TEST_SUITE_P(Rods, BaselineFall,
                         testing::Values(Fall{"explicit_euler", 10, 256, 3e-4},
                                         Fall{"rk2", 10, 128, 3e-4}, Fall{"rk4", 1, 32, 6e-5},
                                         Fall{"rk4", 10, 32, 3e-4}, Fall{"rk4", 100, 32, 5e-4},
                                         Fall{"verlet", 1, 32, 6e-5}, Fall{"verlet", 10, 32, 3e-4},
                                         Fall{"verlet", 100, 32, 5e-4}, Fall{"xpbd", 1, 256, 4e-3},
                                         Fall{"xpbd", 10, 128, 3e-3}, Fall{"xpbd", 100, 64, 5e-3},
                                         Fall{"rod", 1, 1, 2e-3}, Fall{"rod", 10, 1, 2.5e-3},
                                         Fall{"rod", 100, 1, 3.5e-3}));

// PBD is stiff with sweeps too, but slowly.
TEST(BaselinePbd, sweeps_shorten_a_hanging_strand) {
    float before = 1e9f;
    for (const uint32_t sweeps : {1u, 4u, 16u, 64u}) {
        OneStrand strand = strand_of("pbd", desc_of(1, sweeps), hanging);
        strand.run(10.0);
        EXPECT_LT(strand.measure().max_stretch, 0.5f * before) << sweeps;
        before = strand.measure().max_stretch;
    }
    EXPECT_LT(before, 0.05f);
}

// Every segment carries what is below it: sum of l W/EA.
TEST(BaselineSprings, hang_as_long_as_their_springs_say) {
    constexpr uint32_t segments = 16;
    constexpr float weight = line_density * g; // N/m
    for (const char* baseline : {"explicit_euler", "rk2", "rk4", "verlet"}) {
        plait::SimDesc desc = desc_of(128);
        desc.material.stretch_stiffness = 20.0f * weight;
        desc.params.drag = 10.0f;
        OneStrand strand = strand_of(baseline, desc, hanging);
        strand.run(8.0);
        double length = 1.0;
        for (uint32_t i = 0; i < segments; ++i) // half a segment's mass at the tip
            length += (1.0 - (i + 0.5) / segments) / 20.0 / segments;
        EXPECT_NEAR(strand.tip()[1], -length, 2e-5) << baseline;
    }
}

// ---- where the explicit ones stop ---------------------------------------------------------------

// Fastest vertex after 5 s of the rod of gamma 10 and 16 segments, its stretch slower than its
// bending, at `share` of the longest step that central differences bear.
float speed_at_limit(const char* baseline, double share) {
    double dt_max = 0;
    for (const auto& row : read_table("explicit_limit.csv"))
        if (row[0] == 10 && row[1] == 16)
            dt_max = row[3];
    plait::SimDesc desc = desc_of(1);
    make_rod(desc, 10, 0.3f);
    desc.material.stretch_stiffness = 40.0f * line_density * g;
    desc.step = static_cast<float>(share * dt_max) * unit_time;
    OneStrand strand = strand_of(baseline, desc, level);
    strand.run(5.0);
    const plait_sim_measures stats = strand.measure();
    return stats.nonfinite ? INFINITY : stats.max_speed;
}

TEST(BaselineLimit, verlet_holds_to_central_differences_limit) {
    EXPECT_LT(speed_at_limit("verlet", 0.95), 0.5f);
    EXPECT_GT(speed_at_limit("verlet", 1.02), 20.0f);
}

TEST(BaselineLimit, rk4_holds_sqrt_2_as_long) {
    EXPECT_LT(speed_at_limit("rk4", 1.40), 0.5f);
    EXPECT_GT(speed_at_limit("rk4", 1.46), 20.0f);
}

TEST(BaselineLimit, midpoint_and_euler_hold_less) {
    EXPECT_LT(speed_at_limit("rk2", 0.2), 0.5f);
    EXPECT_GT(speed_at_limit("rk2", 0.5), 20.0f);
    EXPECT_LT(speed_at_limit("explicit_euler", 0.04), 0.5f);
    EXPECT_GT(speed_at_limit("explicit_euler", 0.2), 20.0f);
}

// ---- order --------------------------------------------------------------------------------------

struct Order {
    const char* baseline;
    uint32_t substeps;
    double order;
};

// A soft strand, half a second at `substeps`, twice and four times as many: how fast they agree.
double measured_order(const Order& c) {
    std::vector<std::vector<std::array<float, 4>>> x;
    for (const uint32_t substeps : {c.substeps, 2 * c.substeps, 4 * c.substeps}) {
        plait::SimDesc desc = desc_of(substeps);
        desc.step = 1.0f / 16.0f;
        make_rod_material(desc, 100.0f);
        desc.material.stretch_stiffness = 10.0f * line_density * g;
        OneStrand strand = strand_of(c.baseline, desc, level, 4);
        strand.run(0.5);
        x.push_back(strand.read(PLAIT_FIELD_POSITION));
    }
    const auto apart = [](const auto& a, const auto& b) {
        double worst = 0;
        for (size_t i = 0; i < a.size(); ++i)
            for (size_t k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(double(a[i][k]) - double(b[i][k])));
        return worst;
    };
    return std::log2(apart(x[0], x[1]) / apart(x[1], x[2]));
}

TEST(BaselineOrder, is_what_the_books_say) {
    for (const Order& c : {Order{"explicit_euler", 128, 1}, Order{"verlet", 16, 1},
                           Order{"rk2", 16, 2}, Order{"rk4", 4, 4}})
        EXPECT_NEAR(measured_order(c), c.order, 0.35) << c.baseline;
}

// ---- conservation ------------------------------------------------------------------------------

// Angular momentum of a limp strand about its pinned root, kg m^2/s; the tip has half a mass.
double angular_momentum(const OneStrand& strand) {
    const auto x = strand.read(PLAIT_FIELD_POSITION), v = strand.read(PLAIT_FIELD_VELOCITY);
    double sum = 0;
    for (size_t i = 1; i < x.size(); ++i)
        sum += (i + 1 < x.size() ? 1.0 : 0.5) *
               (double(x[i][0]) * double(v[i][1]) - double(x[i][1]) * double(v[i][0]));
    return sum * double(line_density) / static_cast<double>(x.size() - 1);
}

TEST(BaselineMomentum, a_spinning_limp_strand_keeps_it) {
    const std::pair<const char*, uint32_t> baselines[] = {
        {"explicit_euler_limp", 256},
        {"rk2_limp", 256},
        {"rk4_limp", 256},
        {"verlet_limp", 256},
        {"pbd", 32}}; // whose velocities are differences of places: more lose to rounding
    for (const auto& [baseline, substeps] : baselines) {
        plait::SimDesc desc = desc_of(substeps);
        desc.params.gravity[1] = 0.0f;
        desc.params.drag = 0.0f;
        OneStrand strand = strand_of(baseline, desc, level);
        auto v = strand.read(PLAIT_FIELD_VELOCITY);
        for (size_t i = 0; i < v.size(); ++i) // not rigid: the tip faster than it would be
            v[i][1] = std::pow(static_cast<float>(i) / 16.0f, 2.0f);
        PLAIT_EXPECT(
            plait_sim_write(strand.sim(), PLAIT_FIELD_VELOCITY, v.data(), v.size() * sizeof v[0]));
        const double before = angular_momentum(strand);
        strand.run(1.0);
        EXPECT_NEAR(angular_momentum(strand) / before, 1.0, 0.003) << baseline;
    }
}

// ---- rest shape --------------------------------------------------------------------------------

// Three turns of 3 cm, where nothing pulls: they are at rest as groomed.
TEST(BaselineCurls, stay_as_groomed_without_gravity) {
    constexpr uint32_t vertices = 33;
    std::vector<Vec3> curl;
    for (uint32_t i = 0; i < vertices; ++i) {
        const float angle = 0.6f * static_cast<float>(i);
        curl.push_back({0.01f * static_cast<float>(i), 0.03f * (std::cos(angle) - 1.0f),
                        0.03f * std::sin(angle)});
    }
    const std::pair<const char*, uint32_t> baselines[] = {
        {"explicit_euler", 512}, {"rk2", 256}, {"rk4", 128},
        {"verlet", 128},         {"xpbd", 16}, {"xpbd_heavy", 16}};
    for (const auto& [baseline, substeps] : baselines) {
        plait::SimDesc desc = desc_of(substeps);
        desc.params.gravity[1] = 0.0f;
        desc.material.bend_stiffness = 1e-6f;
        OneStrand strand(curl, vertices, desc, context_of(baseline));
        strand.run(0.5);
        const auto x = strand.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < vertices; ++i)
            for (size_t k = 0; k < 3; ++k)
                EXPECT_NEAR(x[i][k], curl[i][k], 1e-4f) << baseline << ", vertex " << i;
    }
}

// ---- accelerations of vertices -----------------------------------------------------------------

// They pull at single masses as gravity does at all: the one in place of the other changes nothing.
TEST(BaselineAccelerations, pull_as_gravity_does) {
    for (const char* baseline : {"explicit_euler", "rk2", "rk4", "verlet", "verlet_limp", "pbd",
                                 "xpbd", "chain", "cosserat", "rod"}) {
        plait::SimDesc desc = desc_of(256);
        make_rod_material(desc, 10.0f);
        OneStrand falls = strand_of(baseline, desc, level);
        desc.params.gravity[1] = 0.0f;
        desc.acceleration.on = true;
        OneStrand pulled = strand_of(baseline, desc, level);
        auto a = pulled.read(PLAIT_FIELD_ACCELERATION);
        for (auto& at : a)
            at[1] = -g;
        PLAIT_EXPECT(plait_sim_write(pulled.sim(), PLAIT_FIELD_ACCELERATION, a.data(),
                                     a.size() * sizeof a[0]));
        falls.run(0.25);
        pulled.run(0.25);
        EXPECT_LT(falls.tip()[1], -0.1f) << baseline;
        EXPECT_NEAR(pulled.tip()[1], falls.tip()[1], 1e-5f) << baseline;
    }
}

} // namespace
} // namespace plait::test
