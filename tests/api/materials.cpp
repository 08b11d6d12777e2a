// Several materials in one sim: each strand as if it were alone with its own, ramps along it, and
// the curl it has at rest.
#include "support.hpp"

#include <algorithm>

namespace {

plait::SimDesc desc_of() {
    plait::SimDesc desc;
    return desc;
}

plait_material stiff() {
    auto material = plait_material_defaults();
    material.line_density = 2e-5f;
    material.bend_stiffness = 3e-7f;
    material.twist_stiffness = 2e-7f;
    return material;
}

std::vector<float> after(plait::Sim& sim, int steps) {
    run(sim, steps);
    return sim.read(PLAIT_FIELD_POSITION);
}

std::vector<float> strand_of(const std::vector<float>& positions, size_t strand, size_t vertices) {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(4 * strand * vertices);
    return {first, first + static_cast<std::ptrdiff_t>(4 * vertices)};
}

std::string refusal(plait_sim* sim, const plait_material* list, size_t count, plait_view of) {
    EXPECT_EQ(plait_sim_set_materials(sim, list, count, of), PLAIT_INVALID_ARGUMENT);
    return plait_last_error();
}

class Materials : public OnBackend {};
ON_EVERY_BACKEND(Materials);

// To the bit.
TEST_P(Materials, EachStrandIsAsInASimOfItsMaterial) {
    std::vector<plait_material> list(3, plait_material_defaults());
    list[0] = stiff();
    list[2].line_density = 1e-5f;
    list[2].bend_stiffness = 5e-8f;
    const std::vector<uint32_t> of{1, 0, 2, 0, 1};
    auto desc = desc_of();
    std::vector<std::vector<float>> alone;
    for (const plait_material& material : list) {
        auto one = desc;
        one.material = material;
        plait::Sim sim(context, make_groom(tuft(5, 12)), one);
        alone.push_back(after(sim, 20));
    }
    desc.materials = list.data();
    desc.material_count = list.size();
    desc.strand_material = plait::view(of);
    plait::Sim sim(context, make_groom(tuft(5, 12)), desc);
    const auto mixed = after(sim, 20);
    for (size_t strand = 0; strand < of.size(); ++strand)
        EXPECT_EQ(strand_of(mixed, strand, 12), strand_of(alone[of[strand]], strand, 12))
            << "strand " << strand;
    const float apart = 0.01f;
    EXPECT_GE(largest_difference(alone[0], alone[1]), apart);
}

// From the next step on, without a jump; none again is the default one.
TEST_P(Materials, ChangeWhileTheSimRuns) {
    plait::Sim sim(context, make_groom(tuft(3, 12)), desc_of());
    plait::Sim same(context, make_groom(tuft(3, 12)), desc_of());
    auto limp = after(sim, 30);
    EXPECT_EQ(limp, after(same, 30));
    const plait_material material = stiff();
    ASSERT_EQ(plait_sim_set_materials(sim, &material, 1, {}), PLAIT_OK) << plait_last_error();
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), limp);
    EXPECT_GT(largest_difference(after(sim, 30), after(same, 30)), 0.01f);
    ASSERT_EQ(plait_sim_set_materials(sim, nullptr, 0, {}), PLAIT_OK) << plait_last_error();
    plait_sim_reset(sim);
    plait_sim_reset(same);
    EXPECT_EQ(after(sim, 10), after(same, 10));
}

// A strand that is switched keeps what it is made of.
TEST_P(Materials, GoAlongThroughASwitchOfSettings) {
    auto material = stiff();
    material.curl = 0.5f;
    auto desc = desc_of();
    desc.materials = &material;
    desc.material_count = 1;
    plait::Sim born(context, make_groom(tuft(3, 12)), desc);
    plait::Sim switched(context, make_groom(tuft(3, 12)), desc);
    take_substeps(switched, {2, 2, 2});
    run(switched, 5);
    take_substeps(switched, {1, 1, 1});
    plait_sim_reset(born);
    plait_sim_reset(switched);
    EXPECT_EQ(after(switched, 10), after(born, 10));
}

// Small deflections of a level cantilever under its weight, by the unit load.
double beam_sag(const plait_material& m, double L, double g) {
    const auto ramp = [](const float(&knots)[4], double share) {
        const auto k = std::min(static_cast<size_t>(3 * share), size_t{2});
        return knots[k] + (3 * share - static_cast<double>(k)) * (knots[k + 1] - knots[k]);
    };
    constexpr int n = 2000;
    double sag = 0, weight = 0, moment = 0; // of what is beyond s
    for (int i = n - 1; i >= 0; --i) {
        const double ds = L / n, s = (i + 0.5) * ds;
        moment += weight * ds;
        weight += m.line_density * ramp(m.density_ramp, s / L) * g * ds;
        sag += moment * (L - s) / (m.bend_stiffness * ramp(m.stiffness_ramp, s / L)) * ds;
    }
    return sag;
}

TEST_P(Materials, RampsBendAsABeamWithThem) {
    Strand level;
    for (size_t i = 0; i < 33; ++i)
        level.push_back({0.1f * static_cast<float>(i) / 32, 0, 0});
    auto material = plait_material_defaults();
    material.bend_stiffness = 1e-6f;
    const float stiffness[] = {1, 0.3f, 0.6f, 0.1f}, density[] = {1, 2, 0.5f, 0.8f};
    const double even = beam_sag(material, 0.1, 9.81);
    std::copy_n(stiffness, 4, material.stiffness_ramp);
    std::copy_n(density, 4, material.density_ramp);
    const double sag = beam_sag(material, 0.1, 9.81);
    EXPECT_GT(sag, 1.3 * even);
    auto desc = desc_of();
    desc.params.drag = 30;
    desc.params.gravity[1] = -9.81f;
    desc.material.stretch_stiffness = 100;
    material.stretch_stiffness = 100;
    desc.materials = &material;
    desc.material_count = 1;
    plait::Sim sim(context, make_groom({level}), desc);
    const double found = -double(after(sim, 120)[4 * 32 + 1]);
    EXPECT_NEAR(found / sag, 1, 0.01);
}

// Of all joints but the clamp, rad.
double turn_of(const std::vector<float>& x) {
    const auto edge = [&](size_t i, size_t c) {
        return double(x[4 * (i + 1) + c]) - double(x[4 * i + c]);
    };
    double sum = 0;
    for (size_t i = 1; 4 * (i + 1) < x.size(); ++i) {
        double square = 0, along = 0; // of |cross|, and the product
        for (size_t c = 0; c < 3; ++c) {
            const size_t d = (c + 1) % 3;
            const double cross = edge(i - 1, c) * edge(i, d) - edge(i - 1, d) * edge(i, c);
            square += cross * cross;
            along += edge(i - 1, c) * edge(i, c);
        }
        sum += std::atan2(std::sqrt(square), along);
    }
    return sum;
}

// Without a load; what was set begins without a jump.
TEST_P(Materials, CurlScalesTheShapeAtRest) {
    for (const float scale : {0.0f, 0.5f, 1.0f, 2.0f}) {
        auto desc = desc_of();
        std::fill_n(desc.params.gravity, 3, 0.0f);
        desc.params.drag = 20;
        plait::Sim sim(context, make_groom(tuft(1, 12)), desc);
        const auto groom = sim.read(PLAIT_FIELD_POSITION);
        auto material = plait_material_defaults();
        material.bend_stiffness = 1e-6f;
        material.curl = scale;
        ASSERT_EQ(plait_sim_set_materials(sim, &material, 1, {}), PLAIT_OK) << plait_last_error();
        plait_sim_reset(sim);
        EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), groom);
        EXPECT_NEAR(turn_of(after(sim, 300)) / turn_of(groom), scale, 0.005) << "" << scale;
    }
}

// In balance as groomed; with less curl than that it leaves the shape.
TEST_P(Materials, CurlsFromASagFreeStart) {
    for (const float scale : {1.0f, 0.5f}) {
        auto material = plait_material_defaults();
        material.bend_stiffness = 1e-7f;
        material.curl = scale;
        auto desc = desc_of();
        desc.sag_free = PLAIT_SAG_FREE_STIFFEN;
        desc.materials = &material;
        desc.material_count = 1;
        plait::Sim sim(context, make_groom(tuft(1, 12)), desc);
        const auto start = sim.read(PLAIT_FIELD_POSITION);
        const float moved = largest_difference(after(sim, 60), start);
        EXPECT_TRUE(scale == 1 ? moved < 1e-4f : moved > 5e-3f) << ": " << moved;
    }
}

// A bristle on a hinge hangs; clamped, it stands out.
TEST_P(Materials, AClampWithoutStiffnessIsAHinge) {
    Strand level;
    for (size_t i = 0; i < 9; ++i)
        level.push_back({0.1f * static_cast<float>(i) / 8, 0, 0});
    auto material = plait_material_defaults();
    material.bend_stiffness = 1e-5f;
    for (const float clamp : {1.0f, 0.0f}) {
        auto desc = desc_of();
        desc.params.drag = 10;
        material.clamp_stiffness = clamp;
        desc.materials = &material;
        desc.material_count = 1;
        plait::Sim sim(context, make_groom({level}), desc);
        const auto x = after(sim, 300);
        EXPECT_NEAR(x[4 * 8 + 1], clamp > 0 ? 0 : -0.1f, 1e-3f);
    }
}

TEST_P(Materials, OutsideTheirRangesAreRefusedWhole) {
    plait::Sim sim(context, make_groom(tuft(2, 6)), desc_of());
    std::vector<plait_material> list(2, plait_material_defaults());
    std::vector<uint32_t> of{0, 1};
    const auto is_refused = [&](const std::string& message) {
        const std::string said = refusal(sim, list.data(), list.size(), plait::view(of));
        EXPECT_NE(said.find(message), std::string::npos) << said;
    };
    list[1].line_density = 0;
    is_refused("materials[1].line_density is 0, range is [1e-09, 1000]");
    list[1] = plait_material_defaults();
    list[0].stiffness_ramp[2] = NAN;
    is_refused("materials[0].stiffness_ramp[2] is nan, range is [0, 100]");
    list[0] = plait_material_defaults();
    list[1].density_ramp[3] = 0;
    is_refused("materials[1].density_ramp[3] is 0, range is [0.001, 1000]");
    list[1] = plait_material_defaults();
    list[0].curl = 5;
    is_refused("materials[0].curl is 5, range is [0, 4]");
    list[0] = plait_material_defaults();
    of[1] = 2;
    is_refused("strand_material[1] is 2, range is [0, 1]");
    of = {0};
    is_refused("strand_material.count is 1, the groom has 2 strands");
    of = {0, 0};
    list[1].struct_size = 8;
    is_refused("materials[1].struct_size is 8");
    EXPECT_NE(refusal(sim, nullptr, 1, {}).find("materials is NULL"), std::string::npos);
    EXPECT_NE(refusal(sim, nullptr, 0, plait::view(of)).find("there are no materials"),
              std::string::npos);
    plait::Sim untouched(context, make_groom(tuft(2, 6)), desc_of());
    EXPECT_EQ(after(sim, 5), after(untouched, 5));
}

TEST_P(Materials, AreRefusedByTressfxWhoseStiffnessIsNone) {
    auto desc = tressfx_desc();
    const plait_material material = plait_material_defaults();
    plait::Sim sim(context, make_groom(tuft(2, 6)), desc);
    EXPECT_EQ(plait_sim_set_materials(sim, &material, 1, {}), PLAIT_INVALID_STATE);
    desc.materials = &material;
    desc.material_count = 1;
    EXPECT_THROW(plait::Sim(context, make_groom(tuft(2, 6)), desc), plait::Error);
    EXPECT_NE(std::string(plait_last_error()).find("material_count is 1"), std::string::npos);
}

// The caller's own: of an older plait.h, structs end earlier.
TEST_P(Materials, MayBeOfAnOlderHeader) {
    auto desc = desc_of();
    plait_material old = stiff();
    old.struct_size = offsetof(plait_material, curl);
    old.curl = NAN; // beyond it
    desc.materials = &old;
    desc.material_count = 1;
    plait::Sim sim(context, make_groom(tuft(2, 6)), desc);
    const plait_material now = stiff();
    desc.materials = &now;
    plait::Sim same(context, make_groom(tuft(2, 6)), desc);
    EXPECT_EQ(after(sim, 5), after(same, 5));
}

} // namespace
