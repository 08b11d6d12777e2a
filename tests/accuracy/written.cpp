// Hair that is written where other hair is, with its velocities, goes on as that does.
#include "api/support.hpp"
#include "generator/generator.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace {

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step

struct Hair {
    plait_generator::Hairstyle style;
    float stiffness; // N m^2
    uint32_t substeps;
    double most_next, most_later; // m, rms, after one step and after 18
};

void PrintTo(const Hair& hair, std::ostream* out) {
    *out << plait_generator::hairstyle_name(hair.style) << " in " << hair.substeps << " substeps";
}

plait_roots shaken(int number) {
    const double time = number * frame;
    const auto half = static_cast<float>(0.279 * std::min(1.0, time / 0.4) *
                                         std::sin(2 * 3.14159265358979 * 1.3 * time));
    return head_at({0, 0, 0}, {0, std::sin(half), 0, std::cos(half)});
}

plait::Sim settled(const plait::Context& context, const Hair& hair) {
    auto style = plait_generator::make_style(hair.style);
    style.strands = 300;
    const auto strands = plait_generator::make_groom(style);
    auto groom = plait_groom_desc_defaults();
    groom.positions = plait::view(strands.positions, 3);
    groom.vertex_counts = plait::view(strands.vertex_counts);
    plait::SimDesc desc;
    desc.substeps = hair.substeps;
    desc.params.drag = 4;
    desc.material.bend_stiffness = hair.stiffness;
    plait::Sim sim(context, plait::Groom(groom), desc);
    for (int i = 0; i < 60; ++i)
        sim.step(slightly_more);
    return sim;
}

double away(const plait::Sim& a, const plait::Sim& b) {
    const auto x = a.read(PLAIT_FIELD_POSITION), y = b.read(PLAIT_FIELD_POSITION);
    double squares = 0;
    for (size_t i = 0; i < x.size(); ++i)
        squares += i % 4 < 3 ? std::pow(double(x[i]) - double(y[i]), 2) : 0;
    return std::sqrt(squares / (static_cast<double>(x.size()) / 4));
}

class Written : public testing::TestWithParam<Hair> {};

// In mid-shake, into a sim that hung still until then.
TEST_P(Written, GoesOnAsWhatItWasCopiedFrom) {
    const Hair& hair = GetParam();
    const plait::Context context;
    plait::Sim from = settled(context, hair), to = settled(context, hair);
    const auto step = [](plait::Sim& sim, int number) {
        sim.set_roots(shaken(number));
        sim.step(slightly_more);
    };
    for (int i = 1; i <= 70; ++i)
        step(from, i);
    to.teleport(shaken(70));
    const double before = away(from, to);
    to.write(PLAIT_FIELD_POSITION, from.read(PLAIT_FIELD_POSITION));
    to.write(PLAIT_FIELD_VELOCITY, from.read(PLAIT_FIELD_VELOCITY));
    EXPECT_GT(before, 0.02);
    EXPECT_LT(away(from, to), 1e-6);
    double next = 0;
    for (int i = 71; i <= 88; ++i) {
        step(from, i);
        step(to, i);
        next = i == 71 ? away(from, to) : next;
    }
    const double later = away(from, to);
    std::printf("%.1f mm apart; after the step that follows %.3f, after 18 %.3f\n", 1e3 * before,
                1e3 * next, 1e3 * later);
    EXPECT_LT(next, hair.most_next);
    EXPECT_LT(later, hair.most_later);
}

using plait_generator::Hairstyle;
INSTANTIATE_TEST_SUITE_P(Hair, Written,
                         testing::Values(Hair{Hairstyle::Long, 4.7e-8f, 1, 0.2e-3, 2e-3},
                                         Hair{Hairstyle::Long, 4.7e-8f, 2, 0.2e-3, 2e-3},
                                         Hair{Hairstyle::Curly, 7e-9f, 1, 3e-3, 2e-3}));

} // namespace
