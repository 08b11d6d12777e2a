// What holds hair in its groom: the slider `groom` and the springs of materials, one droop whatever
// the step; and gravity that changes, which a sag-free groom feels.
#include "support.hpp"

#include <algorithm>

namespace {

class GroomSpring : public OnBackend {
  protected:
    plait::Sim make(const Strand& strand, const plait::SimDesc& desc) {
        return plait::Sim(context, make_groom({strand}), desc);
    }
    // m, of the tip of a level strand.
    float droop(const Strand& strand, plait::SimDesc desc) {
        constexpr double seconds = 3;
        desc.params.drag = 10; // at rest by then
        plait::Sim sim = make(strand, desc);
        const int steps = static_cast<int>(std::lround(seconds / double(desc.step)));
        for (int i = 0; i < steps; ++i)
            sim.step(double(desc.step));
        return -tip_of(sim)[1];
    }
    static Point tip_of(plait::Sim& sim) {
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        return {x[x.size() - 4], x[x.size() - 3], x[x.size() - 2]};
    }
};
ON_EVERY_BACKEND(GroomSpring);

constexpr float length = 0.3f;

Strand level(size_t vertices) {
    Strand strand;
    for (size_t i = 0; i < vertices; ++i)
        strand.push_back({length * static_cast<float>(i) / static_cast<float>(vertices - 1), 0, 0});
    return strand;
}

plait::SimDesc with_groom(float groom) {
    plait::SimDesc desc;
    desc.params.groom = groom;
    return desc;
}

// One value within 5 %, where a constraint after the step had 176 mm at 30 Hz and 1 mm at 480.
TEST_P(GroomSpring, DroopDoesNotDependOnTheStep) {
    for (const float groom : {0.5f, 0.95f}) {
        auto desc = with_groom(groom);
        const float at_60 = droop(level(16), desc);
        for (const float rate : {30.0f, 120.0f, 480.0f}) {
            desc.step = 1 / rate;
            EXPECT_NEAR(droop(level(16), desc), at_60, 0.05f * at_60) << rate;
        }
        desc.step = 1.0f / 60;
        for (const uint32_t substeps : {2u, 8u}) {
            desc.substeps = substeps;
            EXPECT_NEAR(droop(level(16), desc), at_60, 0.05f * at_60) << substeps;
        }
    }
}

// Limp hair, hair, and hair that hardly droops; coarse and fine.
TEST_P(GroomSpring, TheSliderIsTheShareOfTheDroopThatIsTakenAway) {
    for (const float stiffness : {4.7e-10f, 4.7e-9f, 2e-7f, 2e-6f})
        for (const size_t vertices : {size_t{6}, size_t{16}}) {
            auto desc = with_groom(0);
            desc.material.bend_stiffness = stiffness;
            const float free = droop(level(vertices), desc);
            float before = 1;
            for (const float groom : {0.25f, 0.5f, 0.75f, 1.0f}) {
                desc.params.groom = groom;
                const float share = droop(level(vertices), desc) / free;
                EXPECT_NEAR(share, 1 - groom, groom == 0.5f ? 0.075f : 0.1f)
                    << stiffness << " " << vertices << " " << groom;
                EXPECT_LT(share, before);
                before = share;
            }
            EXPECT_LT(before, 1e-3f);
        }
}

plait_material held_by(float stiffness) {
    auto material = plait_material_defaults();
    material.groom_stiffness = stiffness;
    return material;
}

// The weight of hair, per length, over the spring's stiffness, but for the ends.
TEST_P(GroomSpring, OfAMaterialIsANewtonPerMetreAndMetreOfHair) {
    const float weight = 5e-6f * 9.81f;
    auto material = held_by(100 * weight / length);
    plait::SimDesc desc;
    desc.materials = &material;
    desc.material_count = 1;
    for (const size_t vertices : {size_t{11}, size_t{21}, size_t{41}}) {
        plait::Sim sim = make(level(vertices), desc);
        run(sim, 300);
        const auto x = sim.read(PLAIT_FIELD_POSITION);
        EXPECT_NEAR(-x[4 * (vertices / 2) + 1], length / 100, 0.03f * length / 100) << vertices;
    }
    const float all = droop(level(16), desc);
    material.groom_ramp[2] = material.groom_ramp[3] = 0;
    EXPECT_GT(droop(level(16), desc), 5 * all);
    std::fill_n(material.groom_ramp, 4, 4.0f);
    EXPECT_NEAR(droop(level(16), desc), all / 4, 0.05f * all);
}

TEST_P(GroomSpring, GoesWithTheHead) {
    plait::Sim sim(context, make_groom(tuft(4, 12)), with_groom(1));
    const auto rest = sim.read(PLAIT_FIELD_POSITION);
    float farthest = 0;
    for (int i = 1; i <= 90; ++i) {
        const float t = static_cast<float>(i) / 60, x = 0.05f * (1 - std::cos(10 * t));
        const float half = 0.5f * t * t;
        sim.set_roots(head_at({x, 0, 0}, {0, std::sin(half), 0, std::cos(half)}));
        sim.step(frame);
        const auto now = sim.read(PLAIT_FIELD_POSITION);
        const float c = std::cos(2 * half), s = std::sin(2 * half);
        for (size_t v = 0; v < now.size(); v += 4)
            farthest = std::max(farthest, std::hypot(now[v] - (c * rest[v] + s * rest[v + 2] + x),
                                                     now[v + 1] - rest[v + 1],
                                                     now[v + 2] - (c * rest[v + 2] - s * rest[v])));
    }
    EXPECT_LT(farthest, 1e-3f);
}

bool runs_groom(plait::Sim& sim) {
    const auto stages = stages_of(sim);
    return std::ranges::any_of(
        stages, [](const auto& stage) { return stage.first == "lane_groom" && stage.second > 0; });
}

TEST_P(GroomSpring, OffCostsNothing) {
    plait::Sim sim = make(level(8), with_groom(0));
    const uint64_t bytes = sim.describe().device_bytes;
    EXPECT_FALSE(runs_groom(sim));
    auto params = sim.params();
    params.groom = 0.5f;
    sim.set_params(params);
    EXPECT_GT(sim.describe().device_bytes, bytes);
    EXPECT_TRUE(runs_groom(sim));
    params.groom = 0;
    sim.set_params(params);
    EXPECT_FALSE(runs_groom(sim));
}

// Beside a pin and the drag of the air, and over a switch of settings.
TEST_P(GroomSpring, ActsBesidePinsAndWind) {
    auto desc = with_groom(0.9f);
    plait::Sim sim(context, make_groom({level(16), level(16)}), desc);
    sim.set_pins({{0, 15, PLAIT_PIN_FRAME_WORLD, {0.25f, 0.1f, 0}, PLAIT_PIN_HELD}});
    auto wind = plait_wind_desc_defaults();
    wind.velocity[2] = 2;
    sim.set_wind(wind);
    run(sim, 120);
    plait_strand_settings settings = plait_strand_settings_defaults();
    settings.substeps = 2;
    sim.set_settings({plait_strand_settings_defaults(), settings}, {0, 1});
    run(sim, 120);
    const auto x = sim.read(PLAIT_FIELD_POSITION);
    EXPECT_NEAR(x[4 * 15 + 1], 0.1f, 0.01f) << "the pin holds";
    EXPECT_GT(x[4 * 31 + 1], -0.15f * length) << "the groom holds";
    EXPECT_GT(x[4 * 31 + 2], 1e-3f) << "the wind is felt";
}

// A game that turns gravity over: the same as the same force by accelerations.
TEST_P(GroomSpring, GravityThatChangesIsFeltByASagFreeGroom) {
    Strand strand;
    for (size_t k = 0; k < 16; ++k)
        strand.push_back({0.015f * static_cast<float>(k), -0.012f * static_cast<float>(k), 0});
    plait::SimDesc desc;
    desc.sag_free = PLAIT_SAG_FREE_STIFFEN;
    desc.material.bend_stiffness = 4.7e-8f;
    plait::Sim sim = make(strand, desc);
    run(sim, 120);
    EXPECT_NEAR(tip_of(sim)[1], -0.18f, 1e-4f);
    auto params = sim.params();
    params.gravity[1] = 9.81f;
    sim.set_params(params);
    run(sim, 600);
    EXPECT_NEAR(tip_of(sim)[0], 0.068f, 1e-3f);
    EXPECT_NEAR(tip_of(sim)[1], 0.202f, 1e-3f);
    sim.find_balance(); // hair goes back to the groom, under the gravity there is
    run(sim, 600);
    EXPECT_NEAR(tip_of(sim)[0], 0.225f, 2e-3f);
    EXPECT_NEAR(tip_of(sim)[1], -0.18f, 2e-3f);
    EXPECT_LT(sim.describe().sag_residual, 1e-4f);
}

TEST_P(GroomSpring, ThereIsNoBalanceToFindWhereSagFreeIsOff) {
    plait::Sim sim = make(level(4), with_groom(0));
    EXPECT_EQ(plait_sim_find_balance(sim.get()), PLAIT_INVALID_STATE);
    EXPECT_NE(std::string(plait_last_error()).find("sag_free is 0 (off)"), std::string::npos);
}

} // namespace
