// Who gets which level: plait_context_direct.
#include "level_scenes.hpp"

#include <functional>
#include <string>

namespace {

struct Heads {
    plait::Groom groom = make_groom(field(16));
    plait::Levels levels;
    std::vector<plait::Sim> sims;
    std::vector<plait_character> characters;

    Heads(const plait::Context& context, size_t count)
        : levels(levels_of(groom, {256, 64, 16, 0})) {
        for (size_t i = 0; i < count; ++i) {
            plait::SimDesc desc;
            desc.levels = levels;
            sims.emplace_back(context, groom, desc);
            characters.push_back(plait_character_defaults());
            characters[i].sim = sims[i];
            characters[i].pixels_per_metre = 1000;
            characters[i].width = 0.05f; // of 256 hairs
        }
    }
    void aim(int number) {
        const float half = 0.2f * std::sin(0.12f * static_cast<float>(number));
        for (plait::Sim& sim : sims)
            sim.set_roots(head_at({0, 0, 0}, {0, std::sin(half), 0, std::cos(half)}));
    }
    std::vector<plait_sim*> handles() const { return {sims.begin(), sims.end()}; }
    void frames(const plait::Context& context, const plait_director_desc& desc, int count) {
        for (int i = 0; i < count; ++i) {
            aim(i);
            context.direct(characters, desc, frame);
            context.step(handles(), slightly_more);
        }
    }
};

class DirectorOfSims : public OnBackend {};
ON_EVERY_BACKEND(DirectorOfSims);

TEST_P(DirectorOfSims, GivesWhoIsNearMoreThanWhoIsFar) {
    Heads heads(context, 3);
    heads.characters[0].pixels_per_metre = 3000;
    heads.characters[1].pixels_per_metre = 60;
    heads.characters[2].pixels_per_metre = 0;
    auto desc = plait_director_desc_defaults();
    heads.frames(context, desc, 100);
    EXPECT_EQ(heads.sims[0].level().level, 0u);
    EXPECT_GT(heads.sims[1].level().level, 0u);
    EXPECT_EQ(heads.sims[2].level().level, 3u) << "nobody sees it: rigid";
    EXPECT_LT(heads.sims[1].level().shown, 256u);

    heads.characters[2].pixels_per_metre = 3000;
    const auto info = context.direct(heads.characters, desc, frame);
    EXPECT_EQ(info.changed, 1u) << "it is seen again";
    EXPECT_EQ(info.passed_over, 0u);
    EXPECT_GT(info.predicted_ms, 0);
    context.step(heads.handles(), slightly_more);
    EXPECT_EQ(heads.sims[2].level().level, 0u);
}

TEST_P(DirectorOfSims, KnowsHowFarHairSwingsWhetherStepsOverlapOrNot) {
    Heads together(context, 6), apart(context, 1);
    auto desc = plait_director_desc_defaults();
    desc.tolerance_px = 0.05f;
    for (auto* heads : {&together, &apart})
        for (auto& character : heads->characters)
            character.pixels_per_metre = 1e5f; // all strands for all
    for (int i = 0; i < 120; ++i) {
        together.aim(i);
        apart.aim(i);
        context.direct(together.characters, desc, frame);
        context.step(together.handles(), slightly_more);
        apart.sims[0].step(slightly_more);
        for (plait::Sim& sim : together.sims)
            sim.wait(); // so that every probe has come
        apart.sims[0].wait();
    }
    const float swing = apart.sims[0].level().swing;
    EXPECT_GT(swing, 1e-4f);
    EXPECT_LT(swing, 1);
    for (plait::Sim& sim : together.sims)
        EXPECT_NEAR(sim.level().swing, swing, 1e-6f);
}

// Of those the budget is for the others, until they wake, or are seen from so near that more hair is to be shown.
TEST_P(DirectorOfSims, LetsHairSleepThatIsStill) {
    Heads heads(context, 2);
    const auto desc = plait_director_desc_defaults();
    int moved = 0;
    const auto stand = [&] {
        const auto info = context.direct(heads.characters, desc, frame);
        heads.sims[0].set_roots(head_at({}));
        heads.sims[1].set_roots(shaken(moved++));
        context.step(heads.handles(), slightly_more);
        heads.sims[0].wait();
        return info;
    };
    const float both = stand().predicted_ms;
    for (int i = 0; i < 2000 && !heads.sims[0].level().asleep; ++i)
        stand();
    EXPECT_TRUE(heads.sims[0].level().asleep);
    EXPECT_FALSE(heads.sims[1].level().asleep);
    EXPECT_LT(stand().predicted_ms, 0.6f * both);
    EXPECT_TRUE(heads.sims[0].level().asleep);
    heads.characters[0].width = 1; // of what is shown each hair stands for more
    heads.characters[0].pixels_per_metre = 2000;
    heads.sims[0].set_level(choice_of(0, 0, 32));
    stand();
    EXPECT_FALSE(heads.sims[0].level().asleep);
}

TEST_P(DirectorOfSims, PassesOverSimsWithoutLevels) {
    Heads heads(context, 2);
    plait::Sim plain(context, heads.groom, plait::SimDesc());
    heads.characters.push_back(plait_character_defaults());
    heads.characters.back().sim = plain;
    EXPECT_EQ(context.direct(heads.characters, plait_director_desc_defaults(), frame).passed_over,
              1u);
}

TEST_P(DirectorOfSims, NamesWhatIsWrongAndChangesNothing) {
    Heads heads(context, 2);
    const plait::Context other = make_context(GetParam());
    Heads elsewhere(other, 1);
    const auto good = heads.characters;
    struct Case {
        const char* says;
        std::function<void(std::vector<plait_character>&, plait_director_desc&, double&)> make;
    };
    using C = std::vector<plait_character>;
    using D = plait_director_desc;
    const Case cases[] = {
        {"characters[1].sim is NULL", [](C& c, D&, double&) { c[1].sim = nullptr; }},
        {"characters[1].sim is characters[0].sim again",
         [](C& c, D&, double&) { c[1].sim = c[0].sim; }},
        {"characters[1].sim is of another context",
         [&](C& c, D&, double&) { c[1].sim = elsewhere.sims[0]; }},
        {"characters[0].pixels_per_metre is -1, range is [0, 1e+06]",
         [](C& c, D&, double&) { c[0].pixels_per_metre = -1; }},
        {"characters[1].importance is nan, range is [0, 1000]",
         [](C& c, D&, double&) { c[1].importance = NAN; }},
        {"characters[1].width is 1001, range is [0, 1000]",
         [](C& c, D&, double&) { c[1].width = 1001; }},
        {"budget_ms is -1, range is [0, 10000]", [](C&, D& d, double&) { d.budget_ms = -1; }},
        {"tolerance_px is 0, range is [0.05, 100]", [](C&, D& d, double&) { d.tolerance_px = 0; }},
        {"hair_px is 9, range is [0.25, 8]", [](C&, D& d, double&) { d.hair_px = 9; }},
        {"last_ms is -1, range is [0, 10000]", [](C&, D& d, double&) { d.last_ms = -1; }},
        {"hold_s is 61, range is [0, 60]", [](C&, D& d, double&) { d.hold_s = 61; }},
        {"dt is -1, range is [0, 1e9] s", [](C&, D&, double& dt) { dt = -1; }},
    };
    for (const Case& c : cases) {
        auto characters = good;
        auto desc = plait_director_desc_defaults();
        desc.budget_ms = 0.01f; // would send all to the coarsest level
        double dt = frame;
        c.make(characters, desc, dt);
        EXPECT_EQ(
            plait_context_direct(context, characters.data(), characters.size(), &desc, dt, nullptr),
            PLAIT_INVALID_ARGUMENT)
            << c.says;
        EXPECT_NE(std::string(plait_last_error()).find(c.says), std::string::npos)
            << plait_last_error();
    }
    context.step(heads.handles(), slightly_more);
    for (const plait::Sim& sim : heads.sims)
        EXPECT_EQ(sim.level().level, 0u);
}

} // namespace
