// Tests wetness through the API: its effect on one strand, drying, snapshots, and that dry sims
// allocate nothing. Also its effect on volume and follows. Kernels are tested in tests/cases.
#include "forged.hpp"
#include "support.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

constexpr size_t vertices = 13;
constexpr float segment = 1.0f / 64; // m: sums and products of it are exact
constexpr float dry_below = 1e-3f;

plait::SimDesc desc_of() {
    plait::SimDesc desc;
    desc.wetness.on = true;
    return desc;
}

// Powers of two: what wetness makes of them is what it makes of the params, to the bit. EA is given, as
// one chosen by weight is rounded twice.
plait::SimDesc exact() {
    auto desc = desc_of();
    desc.material.line_density = 0x1p-18f;
    desc.material.bend_stiffness = 0x1p-27f;
    desc.material.stretch_stiffness = 0x1p-6f;
    return desc;
}

Strands level_ones(size_t count, size_t length = vertices) {
    Strands strands(count);
    for (size_t s = 0; s < count; ++s)
        for (size_t i = 0; i < length; ++i)
            strands[s].push_back(
                {segment * static_cast<float>(i), 0, 0.125f * static_cast<float>(s)});
    return strands;
}

std::vector<float> strand_of(const std::vector<float>& positions, size_t strand) {
    const auto first = positions.begin() + static_cast<std::ptrdiff_t>(4 * strand * vertices);
    return {first, first + static_cast<std::ptrdiff_t>(4 * vertices)};
}

float tip_height(const std::vector<float>& positions, size_t strand) {
    return positions[4 * (vertices * (strand + 1) - 1) + 1];
}

void wet(plait::Sim& sim, const std::vector<float>& wetness) {
    sim.write(PLAIT_FIELD_WETNESS, wetness);
}

std::vector<float> wetness_of(const plait::Sim& sim) {
    return sim.read(PLAIT_FIELD_WETNESS);
}

class WetnessOf : public OnBackend {};
ON_EVERY_BACKEND(WetnessOf);

// ---- what it does to a strand ------------------------------------------------------------------

// w 0.625 and 0.3125: line density x 1.375 and 1.1875, EI x 0.6875 and 0.84375. Beside dry ones, which
// are as if there were no other.
TEST_P(WetnessOf, StrandsAreThoseOfASimOfThatMaterial) {
    const std::vector<float> wetness{0, 0.625f, 0.3125f, 0};
    auto wind = plait_wind_desc_defaults();
    wind.velocity[2] = 2;
    wind.shelter = 0;
    for (const uint32_t bdf2 : {0u, 1u}) {
        auto desc = exact();
        desc.params.bdf2 = bdf2;
        plait::Sim sim(context, make_groom(level_ones(4)), desc);
        sim.set_wind(wind);
        wet(sim, wetness);
        run(sim, 20);
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < 4; ++i) {
            auto own = desc;
            own.material.line_density *= 1 + 0.6f * wetness[i];
            own.material.bend_stiffness *= 1 - 0.5f * wetness[i];
            plait::Sim alone(context, make_groom(level_ones(4)), own);
            alone.set_wind(wind);
            run(alone, 20);
            EXPECT_LE(largest_difference(strand_of(positions, i),
                                         strand_of(alone.read(PLAIT_FIELD_POSITION), i)),
                      0)
                << "BDF2 " << bdf2 << ", strand " << i;
        }
        EXPECT_GT(std::abs(tip_height(positions, 1) - tip_height(positions, 0)), 1e-4f)
            << ": nothing is felt";
    }
}

// EA that follows from the weight follows from the wet one, and so does what else a material has:
// twist, sections, ramps, clamp. Rounded once more, so to less than the bit.
TEST_P(WetnessOf, OtherMaterialIsThatOfASimOfThatMaterial) {
    auto desc = desc_of();
    auto material = plait_material_defaults();
    material.twist_stiffness = 2e-9f;
    material.section_ratio = 1.5f;
    material.clamp_stiffness = 0.5f;
    const std::array<float, 4> ramp{1, 0.8f, 0.6f, 0.7f};
    std::ranges::copy(ramp, material.stiffness_ramp);
    std::ranges::copy(ramp, material.density_ramp);
    const auto hangs = [&](float wetness, const plait_material& of) {
        auto own = desc;
        own.materials = &of;
        own.material_count = 1;
        plait::Sim sim(context, make_groom(tuft(3, vertices)), own);
        wet(sim, std::vector<float>(3, wetness));
        run(sim, 20);
        return sim.read(PLAIT_FIELD_POSITION);
    };
    auto soaked = material;
    soaked.line_density *= 1.6f;
    soaked.bend_stiffness *= 0.5f;
    soaked.twist_stiffness *= 0.5f;
    const auto expected = hangs(0, soaked);
    EXPECT_LT(largest_difference(hangs(1, material), expected), 2e-5f);
    EXPECT_GT(largest_difference(hangs(0, material), expected), 2e-3f);
}

// q l^4/8EI: weight x 1.6 over EI x 0.5 is a sag of 3.2 times that of dry hair.
TEST_P(WetnessOf, WetCantileversSagThreeTimesAsFar) {
    constexpr double l = double(segment) * (vertices - 1), bend = 1e-5;
    const double sag = 5e-6 * 9.81 * std::pow(l, 4) / (8 * bend);
    auto desc = desc_of();
    desc.material.bend_stiffness = static_cast<float>(bend);
    desc.material.stretch_stiffness = 1; // what follows from the weight shears by an eighth of it
    desc.params.drag = 20;
    plait::Sim sim(context, make_groom(level_ones(3)), desc);
    wet(sim, {0, 1, 0.5f});
    run(sim, 180);
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const auto below = [&](size_t i) { return -double(tip_height(positions, i)); };
    EXPECT_NEAR(below(0), sag, 0.02 * sag);
    EXPECT_NEAR(below(1) / below(0), 3.2, 0.02);
    EXPECT_NEAR(below(2) / below(0), 1.3 / 0.75, 0.01);
}

// Where hair hardly bends, weight and inertia grow alike: it swings as it did, dragged by the params'
// rate. The wind's force is the same on more mass.
TEST_P(WetnessOf, LimpHairSwingsAsBefore) {
    auto desc = desc_of();
    desc.material.bend_stiffness = 0;
    plait::Sim sim(context, make_groom(level_ones(2)), desc);
    wet(sim, {0, 1});
    float lowest[2] = {0, 0}, first[2] = {0, 0};
    for (int i = 0; i < 60; ++i) {
        run(sim, 1);
        const auto positions = sim.read(PLAIT_FIELD_POSITION);
        for (size_t s = 0; s < 2; ++s)
            if (tip_height(positions, s) < lowest[s]) {
                lowest[s] = tip_height(positions, s);
                first[s] = static_cast<float>(i);
            }
    }
    EXPECT_NEAR(lowest[1], lowest[0], 2e-3f);
    EXPECT_NEAR(first[1], first[0], 1); // of 60 frames
    EXPECT_LT(lowest[0], -0.15f);
}

// ---- how it dries ------------------------------------------------------------------------------

TEST_P(WetnessOf, DriesByItsTime) {
    for (const double tau : {0.5, 7.0, 1e6}) {
        auto desc = desc_of();
        desc.wetness.drying_time = static_cast<float>(tau);
        plait::Sim sim(context, make_groom(level_ones(3)), desc);
        const std::vector<float> given{1, 0.5f, 0};
        wet(sim, given);
        EXPECT_EQ(wetness_of(sim), given);
        for (int steps = 1; steps <= 90; ++steps) {
            run(sim, 1);
            const double left = std::exp(-steps * double(1.0f / 60) / double(float(tau)));
            const auto now = wetness_of(sim);
            for (size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(double(now[i]), double(given[i]) * left, 1e-7)
                    << tau << " s, " << steps << " steps";
        }
    }
    plait::Sim stays(context, make_groom(level_ones(2)), desc_of());
    wet(stays, {0.3f, 1});
    run(stays, 60);
    EXPECT_EQ(wetness_of(stays), (std::vector<float>{0.3f, 1}));
}

// A sixth of a second is e^-10: then nothing is left, and hair moves on as it would have dry, to the
// bit, from where it is.
TEST_P(WetnessOf, DryAgainIsDry) {
    auto desc = desc_of();
    desc.wetness.drying_time = 1.0f / 60;
    plait::Sim sim(context, make_groom(tuft(3, vertices)), desc);
    const auto bytes = sim.describe().device_bytes;
    wet(sim, {1, 0.5f, 0.01f});
    EXPECT_GT(sim.describe().device_bytes, bytes);
    run(sim, 3);
    EXPECT_GT(wetness_of(sim)[0], 0.04f);
    EXPECT_EQ(wetness_of(sim)[2], 0) << "e^-3 of 0.01 is below what is felt";
    run(sim, 7);
    EXPECT_EQ(wetness_of(sim), std::vector<float>(3, 0));
    EXPECT_EQ(sim.describe().device_bytes, bytes);
    plait::Sim never(context, make_groom(tuft(3, vertices)), desc);
    const auto saved = sim.save();
    sim.restore(saved); // to float32, where the reference has float64
    never.restore(saved);
    run(sim, 10);
    run(never, 10);
    EXPECT_EQ(sim.hash(), never.hash());
}

// From a sag of 3.2 times a cantilever rises to its own.
TEST_P(WetnessOf, DryingHairRises) {
    auto desc = desc_of();
    desc.material.bend_stiffness = 1e-5f;
    desc.params.drag = 20;
    plait::Sim sim(context, make_groom(level_ones(2)), desc);
    wet(sim, {0, 1});
    run(sim, 120);
    desc.wetness.drying_time = 0.3f;
    sim.set_wetness(desc.wetness.desc());
    float highest = -1;
    for (int i = 0; i < 180; ++i) {
        run(sim, 1);
        highest = std::max(highest, tip_height(sim.read(PLAIT_FIELD_POSITION), 1));
    }
    const auto positions = sim.read(PLAIT_FIELD_POSITION);
    const float dry = tip_height(positions, 0);
    EXPECT_NEAR(tip_height(positions, 1), dry, -0.01f * dry);
    EXPECT_LT(highest, 0.98f * dry) << ": steps of 2 % throw nothing up";
}

// A strand that is let go level, without drag, has no energy but what it falls for; what water takes
// along with it is its share.
TEST_P(WetnessOf, DryingAddsNoEnergy) {
    auto desc = desc_of();
    desc.params.drag = 0;
    desc.material.bend_stiffness = 1e-8f;
    desc.wetness.drying_time = 0.4f;
    plait::Sim sim(context, make_groom(level_ones(1)), desc);
    wet(sim, {1});
    double most = -1, least = 0;
    for (int i = 0; i < 120; ++i) {
        run(sim, 1);
        const auto x = sim.read(PLAIT_FIELD_POSITION), v = sim.read(PLAIT_FIELD_VELOCITY);
        double energy = 0; // of motion and height, over the mass and g times the length
        for (size_t k = 1; k < vertices; ++k) {
            const float* at = &v[4 * k];
            const double speed = std::hypot(double(at[0]), double(at[1]), double(at[2]));
            energy += speed * speed / 2 + 9.81 * double(x[4 * k + 1]);
        }
        energy /= (vertices - 1) * 9.81 * double(segment) * (vertices - 1);
        most = std::max(most, energy);
        least = std::min(least, double(tip_height(x, 0)));
    }
    EXPECT_LT(most, 0.01);
    EXPECT_LT(least, -0.12) << ": it swings";
}

// Material is scaled anew once wetness is more than 0.02 away from what it is scaled by.
TEST_P(WetnessOf, MaterialFollowsInSteps) {
    const auto hangs = [&](const std::vector<float>& wetness) {
        plait::Sim sim(context, make_groom(level_ones(2)), desc_of());
        for (const float w : wetness) {
            wet(sim, {w, 1});
            run(sim, 5);
            EXPECT_EQ(wetness_of(sim)[0], w);
        }
        return sim.read(PLAIT_FIELD_POSITION);
    };
    const auto stays = hangs({0.5f, 0.5f, 0.5f});
    EXPECT_EQ(hangs({0.5f, 0.515f, 0.485f}), stays);
    const auto moved = hangs({0.5f, 0.53f, 0.53f});
    EXPECT_GT(largest_difference(moved, stays), 1e-6f);
    EXPECT_LT(largest_difference(moved, stays), 2e-3f);
}

// ---- where there is none, and what is refused -----------------------------------------------------

TEST_P(WetnessOf, OfDryHairCostsNothingAndChangesNoBit) {
    auto desc = desc_of();
    desc.wetness.drying_time = 3; // of no hair yet
    desc.wetness.cohesion = 9;
    plait::Sim never(context, make_groom(tuft(3, vertices)), desc_of());
    plait::Sim dry(context, make_groom(tuft(3, vertices)), desc);
    plait::Sim stopped(context, make_groom(tuft(3, vertices)), desc_of());
    const auto bytes = never.describe().device_bytes;
    EXPECT_EQ(wetness_of(never), std::vector<float>(3, 0));
    wet(dry, {0, 0, 0});
    wet(stopped, {1, 1, 1});
    wet(stopped, {0, 0, 0});
    for (plait::Sim* sim : {&dry, &stopped}) {
        EXPECT_EQ(sim->describe().device_bytes, bytes);
        EXPECT_EQ(stages_of(*sim), stages_of(never));
        EXPECT_EQ(sim->hash(), never.hash());
        plait_sim_reset(*sim);
        plait_sim_reset(never);
    }
    wet(dry, {0, 0.5f, 0});
    const auto stages = stages_of(dry);
    for (const char* name : {"wetness", "lane_wetness"})
        EXPECT_EQ(std::ranges::count(stages, std::pair{std::string(name), uint64_t{3}}), 1)
            << "" << name;
}

TEST_P(WetnessOf, OutsideItsRangeIsRefused) {
    plait::Sim sim(context, make_groom(tuft(3, vertices)), desc_of());
    const std::vector<float> before{0.25f, 0, 1};
    wet(sim, before);
    const auto refused = [&](const std::vector<float>& wetness, const char* message) {
        EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_WETNESS, wetness.data(), wetness.size() * 4),
                  PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(message), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(wetness_of(sim), before);
    };
    refused({0, -0.5f, 0}, "wetness[1] is -0.5, range is [0, 1]");
    refused({0, 0, 1.5f}, "wetness[2] is 1.5, range is [0, 1]");
    refused({NAN, 0, 0}, "wetness[0] is nan, range is [0, 1]");
    refused({0, 0}, "size is 8 bytes, the guides take 12");
    auto desc = plait_wetness_desc_defaults();
    desc.drying_time = -1;
    EXPECT_EQ(plait_sim_set_wetness(sim, &desc), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("drying_time is -1"), std::string::npos);
}

TEST_P(WetnessOf, TressfxHasNone) {
    plait::Sim sim(context, make_groom(tuft(3, 6)), tressfx_desc());
    const std::vector<float> wetness(3, 0.0f);
    size_t size = 0;
    EXPECT_EQ(plait_sim_write(sim, PLAIT_FIELD_WETNESS, wetness.data(), 12), PLAIT_INVALID_STATE);
    const auto on = plait_wetness_desc_defaults();
    EXPECT_EQ(plait_sim_set_wetness(sim, &on), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("tressfx"), std::string::npos);
    EXPECT_EQ(plait_sim_read(sim, PLAIT_FIELD_WETNESS, nullptr, &size), PLAIT_INVALID_STATE);
    for (const plait_param_info& param : plait::params_list())
        if (const std::string name = param.name; name.starts_with("wetness_")) {
            EXPECT_EQ(param.models & 1u << PLAIT_MODEL_TRESSFX, 0u) << name;
        }
}

// ---- where it is kept --------------------------------------------------------------------------

TEST_P(WetnessOf, StaysOverResetTeleportMaterialAndSettings) {
    const std::vector<float> wetness{1, 0, 0.5f};
    plait::Sim plain(context, make_groom(tuft(3, vertices)), desc_of());
    wet(plain, wetness);
    run(plain, 12);
    const auto expected = plain.read(PLAIT_FIELD_POSITION);

    auto other = desc_of();
    other.material.line_density *= 2;
    plait::Sim sim(context, make_groom(tuft(3, vertices)), other);
    wet(sim, wetness);
    run(sim, 4);
    sim.set_material(desc_of().material);
    run(sim, 4);
    take_substeps(sim, {1, 2, 1});
    run(sim, 4);
    take_substeps(sim, {1, 1, 1});
    sim.teleport(head_at({1, 2, 3}));
    EXPECT_EQ(wetness_of(sim), wetness);
    sim.teleport(head_at({0, 0, 0}));
    plait_sim_reset(sim);
    run(sim, 12);
    EXPECT_EQ(wetness_of(sim), wetness);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION), expected);
}

TEST_P(WetnessOf, SnapshotsHoldItAndWhatMaterialIsScaledBy) {
    auto desc = desc_of();
    desc.wetness.drying_time = 1;
    plait::Sim sim(context, make_groom(tuft(4, vertices)), desc);
    wet(sim, {1, 0.4f, 0.05f, 0});
    run(sim, 7); // between two steps of the material
    const auto saved = sim.save();
    const auto then = wetness_of(sim);
    plait::Sim restored(context, make_groom(tuft(4, vertices)), desc);
    EXPECT_NE(restored.hash(), sim.hash());
    restored.restore(saved);
    EXPECT_EQ(wetness_of(restored), then);
    EXPECT_EQ(restored.hash(), sim.hash());
    run(restored, 20);
    run(sim, 20);
    EXPECT_EQ(wetness_of(restored), wetness_of(sim));
    sim.restore(saved); // what is wet already; both to float32, where the reference has float64
    EXPECT_EQ(wetness_of(sim), then);
    run(sim, 20);
    EXPECT_EQ(restored.hash(), sim.hash());

    plait::Sim dry(context, make_groom(tuft(4, vertices)), desc);
    run(dry, 5);
    const auto hash = dry.hash();
    sim.restore(dry.save());
    EXPECT_EQ(wetness_of(sim), std::vector<float>(4, 0));
    EXPECT_EQ(sim.hash(), hash);
}

TEST_P(WetnessOf, IsCheckedInSnapshots) {
    plait::Sim sim(context, make_groom(tuft(2, vertices)), desc_of());
    wet(sim, {1, 0.5f});
    run(sim, 2);
    const auto hash = sim.hash();
    const auto saved = sim.save();
    const auto refused = [&](size_t at, auto value, const char* message) {
        std::vector<unsigned char> bytes(saved.begin(), saved.end());
        std::memcpy(bytes.data() + at, &value, sizeof value);
        forged::sign(bytes);
        EXPECT_EQ(plait_sim_restore(sim, bytes.data(), bytes.size()), PLAIT_BAD_DATA);
        EXPECT_NE(std::string(plait_last_error()).find(message), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(sim.hash(), hash);
    };
    const size_t block = forged::find_block(saved, "wetn") + forged::block_head;
    refused(block, -1.0, "dried is -1");
    const size_t given = block + sizeof(double), held = given + 2 * sizeof(float);
    refused(given, 1.5f, "wetness[0] is 1.5, range is [0, 1]");
    refused(held + sizeof(float), NAN, "wetness[1] is nan");
}

// ---- what else takes it ------------------------------------------------------------------------

float distance(const std::vector<float>& positions, size_t a, size_t b) {
    return std::hypot(positions[4 * a] - positions[4 * b],
                      positions[4 * a + 1] - positions[4 * b + 1],
                      positions[4 * a + 2] - positions[4 * b + 2]);
}

// To a fifth of their distance in the outer half; roots and lengths stay, and so do the dry ones'.
TEST_P(WetnessOf, FollowsAreDrawnToTheirGuides) {
    constexpr size_t each = 5;
    auto desc = desc_of();
    desc.material.bend_stiffness = 0; // guides that fall alike
    desc.follows_per_guide = each;
    desc.follow_radius = 0.004f;
    plait::Sim dry(context, make_groom(level_ones(2)), desc);
    plait::Sim sim(context, make_groom(level_ones(2)), desc);
    wet(sim, {1, 0});
    run(sim, 1);
    run(dry, 1);
    const auto now = sim.read(PLAIT_FIELD_POSITION), before = dry.read(PLAIT_FIELD_POSITION);
    const auto row = [](size_t strand) { return strand * vertices; };
    for (size_t f = 0; f < 2 * each; ++f) {
        const size_t strand = 2 + f, guide = f / each;
        if (guide == 1) {
            EXPECT_EQ(strand_of(now, strand), strand_of(before, strand)) << f;
            continue;
        }
        EXPECT_NEAR(distance(now, row(strand), row(guide)),
                    distance(before, row(strand), row(guide)), 1e-8f);
        for (size_t i = vertices / 2; i < vertices; ++i) {
            const float off = distance(before, row(strand) + i, row(guide) + i);
            EXPECT_NEAR(distance(now, row(strand) + i, row(guide) + i), 0.2f * off, 0.12f * off)
                << f << ", vertex " << i;
        }
        for (size_t i = 0; i + 1 < vertices; ++i)
            EXPECT_NEAR(distance(now, row(strand) + i, row(strand) + i + 1),
                        distance(before, row(strand) + i, row(strand) + i + 1), 1e-6f);
    }
}

// Of a map, too, by the wetness of the guide with the greatest weight.
TEST_P(WetnessOf, FollowsOfAMapAreDrawnToTheirFirstGuide) {
    Strands beside = level_ones(2);
    for (size_t s = 0; s < 2; ++s)
        for (Point& p : beside[s])
            p[2] = 0.125f * static_cast<float>(s) + 0.02f;
    const plait::Groom follows = make_groom(beside);
    auto map_desc = plait_follow_map_desc_defaults();
    const std::vector<uint32_t> guides{0, 1, 0, 0, 1, 0, 0, 0};
    const std::vector<float> weights{0.75f, 0.25f, 0, 0, 0.75f, 0.25f, 0, 0};
    map_desc.follows = follows;
    map_desc.guide_count = 2;
    map_desc.guides = plait::view(guides, 4);
    map_desc.weights = plait::view(weights, 4);
    const plait::FollowMap map(map_desc);
    auto desc = desc_of();
    desc.follow_map = map;
    plait::Sim sim(context, make_groom(level_ones(2)), desc);
    wet(sim, {0, 0.5f});
    run(sim, 1);
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    const auto apart = [&](size_t follow) {
        return distance(x, (3 + follow) * vertices - 1, (1 + follow) * vertices - 1);
    };
    EXPECT_NEAR(apart(0), 0.02f, 1e-3f);
    EXPECT_NEAR(apart(1), 0.6f * 0.02f, 2e-3f);
}

// Limp layers on a floor. Between walls they keep their room: wet less of it. In the open they run apart
// as a liquid does, but where hair coheres.
TEST_P(WetnessOf, WetHairLiesCloserAndHoldsTogether) {
    constexpr size_t side = 7;
    constexpr float spacing = 0.009f;
    Strands strands;
    for (size_t j = 0; j < side; ++j)
        for (size_t k = 0; k < side; ++k) {
            Strand strand;
            for (size_t i = 0; i < 10; ++i)
                strand.push_back({0.02f * float(i), spacing * float(j), spacing * float(k)});
            strands.push_back(strand);
        }
    auto desc = desc_of();
    desc.material.bend_stiffness = 1e-11f;
    desc.grid.on = true;
    desc.volume.on = true;
    desc.grid.edge_count = 16;
    desc.grid.edge = 0.4f;
    const std::array<float, 3> corner{-0.1f, -0.1f, -0.16f};
    std::ranges::copy(corner, desc.grid.origin);
    const auto height = [&](float wetness, bool walls, float cohesion) {
        desc.wetness.cohesion = cohesion;
        plait::Sim sim(context, make_groom(strands), desc);
        const auto add = [&](size_t axis, float at, float normal) {
            auto plane = smooth_collider();
            plane.kind = PLAIT_COLLIDER_KIND_PLANE;
            std::fill_n(plane.plane.normal, 3, 0.0f);
            plane.plane.point[axis] = at;
            plane.plane.normal[axis] = normal;
            (void)sim.create_collider(plane);
        };
        add(1, -spacing / 2, 1);
        if (walls) {
            add(2, -spacing / 2, 1);
            add(2, spacing * (side - 0.5f), -1);
            add(0, -0.005f, 1);
            add(0, 0.19f, -1);
        }
        wet(sim, std::vector<float>(side * side, wetness));
        run(sim, 60);
        EXPECT_EQ(sim.measure().nonfinite, 0u);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        float sum = 0;
        for (size_t i = 0; i < x.size(); i += 4)
            sum += x[i + 1] + spacing / 2;
        return sum / static_cast<float>(x.size() / 4);
    };
    const float dry = height(0, true, 0);
    EXPECT_LT(height(0.5f, true, 0), 0.8f * dry) << dry;
    EXPECT_LT(height(1, true, 0), 0.65f * dry) << dry;
    const float apart = height(1, false, 0);
    EXPECT_GT(height(1, false, 0.3f), 1.7f * apart) << apart;
    EXPECT_EQ(height(0, false, 0.3f), height(0, false, 0));
}

} // namespace
