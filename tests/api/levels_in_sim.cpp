// A sim whose level changes: what keeps its bits, where strands are woken, what is shown meanwhile; hair of
// no guides; and what goes on as before: snapshots, resets, heads put elsewhere, pins.
#include "level_scenes.hpp"

#include <algorithm>
#include <functional>
#include <memory>

namespace {

// m, of vertices of strands first to last - 1.
double rms(const std::vector<float>& a, const std::vector<float>& b, size_t row, size_t first,
           size_t last) {
    double squares = 0;
    for (size_t i = 4 * first * row; i < 4 * last * row; ++i)
        if (i % 4 != 3)
            squares += std::pow(double(a[i]) - double(b[i]), 2);
    return std::sqrt(squares / double((last - first) * row));
}

class LevelsInASim : public OnBackend {};
ON_EVERY_BACKEND(LevelsInASim);

TEST_P(LevelsInASim, BeginWithAllThatIsEverStepped) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context, 1);
    const auto info = sim.describe();
    EXPECT_EQ(info.guides, 64u);
    EXPECT_EQ(info.strands, 256u);
    const plait_level_state state = sim.level();
    EXPECT_EQ(state.level, 1u);
    EXPECT_EQ(state.shown, 256u);
    EXPECT_EQ(state.blending, 0);
}

// As the sim of that level alone is, to the bit.
TEST_P(LevelsInASim, OfOneLevelAreASimOfItsGuides) {
    const Scene scene = hair();
    const auto [guides, map] = scene.levels.take(1);
    plait::SimDesc desc;
    desc.follow_map = map;
    plait::Sim alone(context, guides, desc), sim = scene.sim(context, 1);
    for (int step = 0; step < 20; ++step) {
        move(alone, step);
        move(sim, step);
    }
    EXPECT_EQ(shown(sim), shown(alone));
    EXPECT_EQ(sim.read(PLAIT_FIELD_TANGENT), alone.read(PLAIT_FIELD_TANGENT));
}

TEST_P(LevelsInASim, KeepTheBitsOfWhatGoesOnBeingStepped) {
    const Scene scene = hair();
    plait::Sim steady = scene.sim(context), sim = scene.sim(context);
    const uint32_t order[] = {1, 2, 0, 2, 1, 0};
    for (int step = 0; step < 60; ++step) {
        if (step % 10 == 5)
            sim.set_level(choice_of(order[step / 10]));
        move(steady, step);
        move(sim, step);
        const auto a = shown(steady), b = shown(sim);
        for (size_t i = 0; i < 4 * 16 * scene.row; ++i)
            ASSERT_EQ(a[i], b[i]) << "step " << step << ", strand " << i / 4 / scene.row;
    }
    EXPECT_EQ(sim.level().level, 0u);
    EXPECT_GT(rms(shown(steady), shown(sim), scene.row, 16, 256), 1e-5) << "nothing was switched";
}

TEST_P(LevelsInASim, ShowTheStepOfASwitchAsIfThereWereNone) {
    const Scene scene = hair();
    for (const auto& [from, to] : {std::pair{0u, 2u}, {2u, 0u}, {2u, 1u}, {1u, 3u}, {3u, 1u}}) {
        plait::Sim steady = scene.sim(context), sim = scene.sim(context);
        for (plait::Sim* each : {&steady, &sim}) {
            each->set_level(choice_of(from, 0));
            for (int step = 0; step < 25; ++step)
                move(*each, step);
        }
        ASSERT_EQ(shown(steady), shown(sim));
        sim.set_level(choice_of(to));
        move(steady, 25);
        move(sim, 25);
        EXPECT_EQ(sim.level().level, to);
        EXPECT_EQ(sim.level().blending, to == 3 ? 0.0f : 0.3f);
        // of 0.2 m
        EXPECT_LT(largest_difference(shown(steady), shown(sim)), 2e-7f) << from << " to " << to;
    }
}

// A second switch while the first one blends, too.
TEST_P(LevelsInASim, AreContinuousHoweverOftenTheyChange) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    enum class Way { steady, blended, sudden };
    const auto fastest = [&](Way way) {
        sim.reset();
        sim.set_level(choice_of(0, 0));
        std::vector<float> before;
        float most = 0;
        for (int step = 0; step < 120; ++step) {
            if (way != Way::steady && step > 20 && step % 8 == 0)
                sim.set_level(
                    choice_of(static_cast<uint32_t>(step / 8 % 4), way == Way::blended ? 0.3f : 0));
            move(sim, step);
            auto now = shown(sim);
            if (step > 20)
                most = std::max(most, largest_difference(before, now));
            before = std::move(now);
        }
        return most;
    };
    const float steady = fastest(Way::steady), sudden = fastest(Way::sudden);
    EXPECT_LT(fastest(Way::blended) - steady, 0.2f * (sudden - steady));
    EXPECT_GT(sudden, 3 * steady);
}

// The offset at the switch is known: levels without blend show what there would be.
TEST_P(LevelsInASim, FadeWhatIsLackingAtItsPace) {
    const Scene scene = hair();
    constexpr float blend = 0.5f;
    plait::Sim blended = scene.sim(context), sudden = scene.sim(context);
    std::vector<float> offset, before;
    for (plait::Sim* each : {&blended, &sudden}) {
        for (int step = 0; step < 20; ++step)
            move(*each, step, 20);
        each->set_level(choice_of(2, each == &blended ? blend : 0));
    }
    for (int step = 20; step < 60; ++step) {
        move(blended, step, 20); // the head stands: frames of roots are the same
        move(sudden, step, 20);
        const auto with = shown(blended), without = shown(sudden);
        std::vector<float> lacking(with.size());
        for (size_t i = 0; i < with.size(); ++i)
            lacking[i] = with[i] - without[i];
        if (step == 20)
            continue; // of the level before
        const float s = std::min(1.0f, static_cast<float>(step - 20) / (60 * blend));
        const float share = 1 - s * s * (3 - 2 * s);
        if (step == 21) {
            offset = lacking;
            for (float& o : offset)
                o /= share;
            EXPECT_GT(largest_difference(offset, std::vector<float>(offset.size())), 1e-3f);
        }
        for (size_t i = 0; i < lacking.size(); ++i)
            ASSERT_NEAR(lacking[i], share * offset[i], 1e-6f) << "step " << step;
    }
    EXPECT_EQ(shown(blended), shown(sudden));
}

TEST_P(LevelsInASim, WakeStrandsWhereTheyWereShown) {
    const plait::Groom all = plait::Groom::load(PLAIT_SOURCE_DIR "/assets/curly.tfx");
    const auto positions = all.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    const auto counts = all.read<uint32_t>(PLAIT_GROOM_FIELD_VERTEX_COUNTS);
    Strands some;
    for (size_t strand = 0, first = 0; strand < counts.size(); first += counts[strand++]) {
        if (strand % 2 != 0)
            continue;
        some.emplace_back();
        for (size_t i = first; i < first + counts[strand]; ++i)
            some.back().push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
    }
    const auto strands = static_cast<uint32_t>(some.size()), guides = strands / 6;
    const Scene scene(some, {strands, guides});
    plait::Sim steady = scene.sim(context), sim = scene.sim(context);
    for (plait::Sim* each : {&steady, &sim}) {
        each->set_level(choice_of(1, 0));
        for (int step = 0; step < 60; ++step)
            move(*each, step);
    }
    sim.set_level(choice_of(0));
    move(steady, 60);
    move(sim, 60);
    const double moved = rms(shown(steady), shown(sim), scene.row, guides, strands);
    EXPECT_LT(moved, 1e-6);
    move(steady, 61);
    move(sim, 61);
    const double off = rms(shown(steady), shown(sim), scene.row, guides, strands);
    RecordProperty("off_um", static_cast<int>(1e6 * off));
    EXPECT_LT(off, 3e-3);
    for (int step = 62; step < 80; ++step) {
        move(steady, step);
        move(sim, step);
    }
    EXPECT_LT(rms(shown(steady), shown(sim), scene.row, guides, strands), 0.05);
}

// Bound where hair hangs, once it does: these curls creep for some seconds.
TEST_P(LevelsInASim, MoveNothingAtRest) {
    const plait::Groom groom = make_groom(field(16));
    plait::SimDesc desc;
    desc.params.drag = 4;
    plait::Sim settling(context, groom, desc);
    for (int i = 0; i < 600; ++i)
        settling.step(slightly_more);
    const plait::Levels levels = levels_of(groom, ladder, settling.read(PLAIT_FIELD_POSITION));
    desc.levels = levels;
    plait::Sim steady(context, groom, desc), sim(context, groom, desc);
    int step = 0;
    const auto pass = [&](int steps) {
        for (int i = 0; i < steps; ++i, ++step)
            for (plait::Sim* each : {&steady, &sim})
                move(*each, step, 60);
    };
    pass(420);
    for (const uint32_t level : {1u, 2u, 3u, 2u, 0u}) {
        sim.set_level(choice_of(level));
        pass(25);
        EXPECT_LT(largest_difference(shown(sim), shown(steady)), 3e-4f) << "to level " << level;
    }
}

TEST_P(LevelsInASim, StayFiniteIfTheyChangeInEveryStep) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context), steady = scene.sim(context);
    float fastest = 0;
    for (int step = 0; step < 300; ++step) {
        sim.set_level(choice_of(step % 2 ? 0 : 2));
        move(sim, step);
        move(steady, step);
        if (step % 2 == 0)
            fastest = std::max(fastest, steady.measure().max_speed);
    }
    sim.set_level(choice_of(0));
    move(sim, 300);
    move(sim, 301);
    const auto measured = sim.measure();
    EXPECT_EQ(measured.nonfinite, 0u);
    EXPECT_LT(measured.max_stretch, 1e-4f);
    EXPECT_LT(measured.max_speed, 2 * fastest);
}

// At 6 m/s, and in a head that goes round: hair that goes along hangs as it did.
TEST_P(LevelsInASim, AreWokenOnAHeadThatMoves) {
    Strands hair;
    for (int i = 0; i < 64; ++i) {
        hair.emplace_back();
        for (int k = 0; k < 12; ++k)
            hair.back().push_back({0.01f * static_cast<float>(i % 8),
                                   -0.025f * static_cast<float>(k),
                                   0.01f * static_cast<float>(i) / 8});
    }
    const Scene scene(hair, {64, 16, 0});
    plait::Sim sim = scene.sim(context, 0, [](auto& d) {
        d.params.air_with_head = 1;
        d.params.drag = 4;
    });
    const auto head = [](int step) {
        auto roots = head_at({0.1f * static_cast<float>(step), 0, 0});
        return roots;
    };
    const auto in_head = [&](int step) {
        auto x = shown(sim);
        for (size_t i = 0; i < x.size(); i += 4)
            x[i] -= head(step).head.t[0];
        return x;
    };
    const auto pass = [&](int first, int last) {
        for (int step = first; step <= last; ++step) {
            sim.set_roots(head(step));
            sim.step(slightly_more);
        }
    };
    pass(-120, 0);
    const auto before = in_head(0);
    int step = 0;
    for (const uint32_t level : {1u, 0u, 2u, 1u, 0u}) {
        sim.set_level(choice_of(level));
        for (int i = 0; i < 12; ++i, ++step) {
            pass(step + 1, step + 1);
            ASSERT_LT(largest_difference(in_head(step + 1), before), 1e-4f)
                << "to level " << level << ", step " << i;
        }
    }
}

// ---- no guides ----------------------------------------------------------------------------------

TEST_P(LevelsInASim, WithoutGuidesGoWithTheHead) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    for (int step = 0; step < 20; ++step)
        move(sim, step);
    sim.set_level(choice_of(3));
    move(sim, 20, 20);
    const auto held = shown(sim);
    const Point way = {0.3f, -0.1f, 1};
    sim.stage_times(true);
    auto roots = shaken(20);
    std::ranges::copy(way, roots.head.t);
    sim.set_roots(roots);
    sim.step(slightly_more);
    const auto moved = shown(sim);
    for (size_t i = 0; i < held.size(); ++i)
        ASSERT_NEAR(moved[i] - held[i], i % 4 < 3 ? way[i % 4] : 0, 2e-6f);
    for (const plait_stage_time& time : sim.stage_times()) {
        const std::string stage = time.stage;
        EXPECT_TRUE(stage == "roots" || stage == "level_show" || stage == "tangents") << stage;
    }
    EXPECT_GT(sim.describe().time, 0.34);
}

TEST_P(LevelsInASim, WithoutGuidesAreResetAndPutElsewhere) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context), fresh = scene.sim(context);
    for (int step = 0; step < 20; ++step)
        move(sim, step);
    sim.set_level(choice_of(3));
    move(sim, 20);
    sim.reset();
    fresh.teleport(shaken(20));
    EXPECT_LT(largest_difference(shown(sim), shown(fresh)), 2e-6f);
    sim.teleport(head_at({0, 2, 0}));
    fresh.teleport(head_at({0, 2, 0}));
    EXPECT_LT(largest_difference(shown(sim), shown(fresh)), 2e-6f);
}

// ---- as before ----------------------------------------------------------------------------------

TEST_P(LevelsInASim, PlaceNoMoreStrandsThanAreShown) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    sim.set_level(choice_of(2, 0.3f, 40));
    for (int step = 0; step < 5; ++step)
        move(sim, step);
    EXPECT_EQ(sim.level().shown, 64u); // a quarter, and where a level ends
    const auto before = shown(sim);
    move(sim, 5);
    const auto after = shown(sim);
    const auto begin = [&](size_t strand) {
        return static_cast<std::ptrdiff_t>(4 * strand * scene.row);
    };
    EXPECT_TRUE(std::equal(before.begin() + begin(64), before.end(), after.begin() + begin(64)));
    EXPECT_FALSE(std::equal(before.begin() + begin(63), before.begin() + begin(64),
                            after.begin() + begin(63)));
    sim.set_level(choice_of(2));
    move(sim, 6);
    EXPECT_EQ(sim.level().shown, 256u);
    EXPECT_GT(rms(shown(sim), after, scene.row, 64, 256), 1e-4);
}

TEST_P(LevelsInASim, AreSavedAndRestored) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context), other = scene.sim(context);
    int step = 0;
    for (const uint32_t level : {2u, 0u, 3u, 1u}) {
        sim.set_level(choice_of(level, 0.3f, level == 2 ? 128 : 0));
        for (int i = 0; i < 8; ++i)
            move(sim, step++);
        other.restore(sim.save());
        EXPECT_EQ(other.level().level, level);
        EXPECT_EQ(other.level().shown, sim.level().shown);
        EXPECT_EQ(other.level().blending, sim.level().blending);
        for (int i = 0; i < 8; ++i, ++step)
            for (plait::Sim* each : {&sim, &other})
                move(*each, step);
        const auto a = shown(sim), b = shown(other);
        const size_t count = 4 * sim.level().shown * scene.row;
        const auto part = [&](const std::vector<float>& x) {
            return std::vector<float>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count));
        };
        // the reference keeps more than what is saved
        EXPECT_LE(largest_difference(part(a), part(b)), GetParam() == "reference" ? 2e-4f : 0.0f)
            << "level " << level;
    }
    plait::Sim finer = scene.sim(context, 1), none(context, scene.groom);
    const auto whole = scene.sim(context).save();
    EXPECT_THROW(finer.restore(whole), plait::Error);
    EXPECT_THROW(none.restore(whole), plait::Error);
}

// Into a sim to which something else was chosen, too.
TEST_P(LevelsInASim, AreSavedWithAChoiceThatWaits) {
    const Scene scene = hair();
    struct Case {
        uint32_t before, chosen, shown;
    };
    for (const Case& c : {Case{2, 0, 0}, {2, 2, 64}, {0, 3, 0}, {3, 1, 0}}) {
        plait::Sim sim = scene.sim(context), other = scene.sim(context);
        sim.set_level(choice_of(c.before, 0));
        for (int step = 0; step < 10; ++step)
            move(sim, step);
        const auto unchosen = sim.save();
        sim.set_level(choice_of(c.chosen, 0.2f, c.shown));
        const auto saved = sim.save();
        EXPECT_TRUE(saved != unchosen);
        for (const bool chosen : {true, false}) {
            other.set_level(choice_of(1, 0.1f, 32)); // which it forgets
            for (plait::Sim* each : {&sim, &other})
                each->restore(chosen ? saved : unchosen);
            EXPECT_EQ(other.level().level, c.before);
            EXPECT_TRUE(other.save() == (chosen ? saved : unchosen));
            for (int step = 10; step < 16; ++step)
                for (plait::Sim* each : {&sim, &other})
                    move(*each, step);
            EXPECT_EQ(other.level().level, chosen ? c.chosen : c.before);
            EXPECT_EQ(other.level().shown, chosen && c.shown > 0 ? c.shown : 256u);
            EXPECT_EQ(other.level().blending, sim.level().blending);
            EXPECT_TRUE(other.save() == sim.save()) << c.before << " to " << c.chosen;
        }
    }
}

TEST_P(LevelsInASim, AreWrittenAndScaled) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    sim.set_level(choice_of(2, 0));
    for (int step = 0; step < 10; ++step)
        move(sim, step);
    const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    EXPECT_NE(velocity[4 * (16 * scene.row - 1) + 1], 0);
    for (size_t i = 4 * 16 * scene.row; i < velocity.size(); ++i)
        ASSERT_EQ(velocity[i], 0);
    auto lifted = shown(sim);
    const auto before = lifted;
    for (size_t i = 0; i < lifted.size(); ++i)
        if (i % 4 == 1 && i / 4 % scene.row > 0)
            lifted[i] += 0.01f;
    sim.write(PLAIT_FIELD_POSITION, lifted);
    EXPECT_GT(rms(before, shown(sim), scene.row, 0, 256), 3e-3);
    auto roots = shaken(10);
    roots.scale = 2;
    sim.set_roots(roots);
    sim.step(slightly_more);
    sim.set_level(choice_of(0));
    for (int i = 0; i < 4; ++i)
        sim.step(slightly_more);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    EXPECT_LT(sim.measure().max_stretch, 1e-4f);
}

TEST_P(LevelsInASim, HoldTheirPinsOnceTheyAreStepped) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    sim.set_level(choice_of(2, 0));
    move(sim, 0, 0);
    const auto x = shown(sim);
    plait_pin pin{};
    pin.stiffness = PLAIT_PIN_HELD;
    pin.strand = 200;
    pin.vertex = 6;
    pin.frame = PLAIT_PIN_FRAME_WORLD;
    const size_t at = 4 * (200 * scene.row + 6);
    for (size_t i = 0; i < 3; ++i)
        pin.target[i] = x[at + i];
    sim.set_pins({pin});
    const auto away = [&] {
        const auto now = shown(sim);
        return std::hypot(now[at] - pin.target[0], now[at + 1] - pin.target[1],
                          now[at + 2] - pin.target[2]);
    };
    for (int step = 1; step < 20; ++step)
        move(sim, step, 0);
    EXPECT_GT(away(), 0.01f) << "it follows";
    sim.set_level(choice_of(0));
    for (int step = 20; step < 60; ++step)
        move(sim, step, 0);
    EXPECT_LT(away(), 1e-3f);
}

TEST_P(LevelsInASim, ShowHairBetweenSteps) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context, 0, [](auto& d) { d.interpolate_output = 1; });
    std::vector<float> before;
    float most = 0, steady = 0;
    for (int call = 0; call < 180; ++call) {
        if (call >= 90 && call % 20 == 0)
            sim.set_level(choice_of(call / 20 % 2 ? 0 : 2));
        sim.set_roots(shaken(0.53 * call));
        sim.step(0.53 * frame);
        auto now = shown(sim);
        if (call > 30) {
            float& largest = call < 90 ? steady : most;
            largest = std::max(largest, largest_difference(before, now));
        }
        before = std::move(now);
    }
    EXPECT_LT(most, 1.6f * steady);
}

// The same that is measured of what is shown, over the last second, whatever the level.
TEST_P(LevelsInASim, SayHowFarHairSwings) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context);
    EXPECT_LT(sim.level().swing, 0);
    constexpr int last = 240, second = 60;
    std::vector<std::vector<float>> seen; // in the head's frame
    for (int step = 0; step < last; ++step) {
        move(sim, step);
        sim.wait(); // so that what was asked for has come
        if (step < last - second)
            continue;
        auto x = shown(sim);
        const plait_pose head = shaken(step).head;
        const auto& q = head.q;
        const float sine = 2 * q[1] * q[3], cosine = 1 - 2 * q[1] * q[1];
        for (size_t i = 0; i < x.size(); i += 4) {
            const float along = x[i], across = x[i + 2];
            x[i] = cosine * along - sine * across;
            x[i + 2] = sine * along + cosine * across;
        }
        seen.push_back(std::move(x));
    }
    double squares = 0;
    for (size_t i = 0; i < seen[0].size(); ++i) {
        if (i % 4 == 3)
            continue;
        double mean = 0;
        for (const auto& x : seen)
            mean += double(x[i]) / second;
        for (const auto& x : seen)
            squares += std::pow(double(x[i]) - mean, 2) / second;
    }
    const double swing = std::sqrt(squares / double(256 * scene.row));
    EXPECT_GT(swing, 5e-3);
    EXPECT_NEAR(double(sim.level().swing), swing, 0.3 * swing);
    for (int step = last; step < 3 * last; ++step) {
        move(sim, step, last);
        sim.wait();
    }
    EXPECT_LT(double(sim.level().swing), 0.1 * swing);
}

// Whatever else is on, and whenever: twice the same bits, and finite.
TEST_P(LevelsInASim, ChangeAmongAllOtherFeatures) {
    const Scene scene(field(8), {64, 16, 4, 0});
    const auto ride = [&](uint32_t seed) {
        plait::Sim sim = scene.sim(context, seed % 2, [&](plait::SimDesc& d) {
            d.substeps = 1 + seed % 2;
            d.wetness.on = d.acceleration.on = true;
            d.keep_last_frame = 1;
        });
        auto body = smooth_collider();
        body.capsule.a[0] = body.capsule.b[0] = 0.15f;
        body.capsule.a[1] = -0.2f;
        body.capsule.b[1] = 0.1f;
        body.capsule.radius_a = body.capsule.radius_b = 0.03f;
        sim.create_collider(body);
        const auto guides = sim.describe().guides;
        uint32_t dice = seed * 2654435761u + 1;
        const auto roll = [&](uint32_t sides) {
            dice = dice * 1664525u + 1013904223u;
            return (dice >> 16) % sides;
        };
        for (int step = 0; step < 60; ++step) {
            if (roll(3) == 0)
                sim.set_level(choice_of(seed % 2 + roll(4 - seed % 2), 0.1f * float(roll(4)),
                                        roll(3) == 0 ? 1 + roll(64) : 0));
            switch (roll(12)) {
            case 0: {
                auto wind = plait_wind_desc_defaults();
                wind.velocity[0] = 3;
                wind.turbulence = static_cast<float>(roll(2));
                sim.set_wind(wind);
                break;
            }
            case 1:
                sim.stop_wind();
                break;
            case 2: {
                auto volume = plait_volume_desc_defaults();
                sim.set_volume(roll(2) ? &volume : nullptr);
                break;
            }
            case 3: {
                auto contact = plait_strand_contact_desc_defaults();
                sim.set_strand_contact(roll(2) ? &contact : nullptr);
                break;
            }
            case 4:
                sim.write(PLAIT_FIELD_WETNESS,
                          std::vector<float>(guides, 0.5f * static_cast<float>(roll(2))));
                break;
            case 5: {
                std::vector<uint32_t> of(guides);
                for (uint32_t& each : of)
                    each = roll(2);
                sim.set_settings({of_substeps(1), of_substeps(3)}, of);
                break;
            }
            case 6:
                sim.teleport(head_at({0, 0.1f * static_cast<float>(roll(5)), 0}));
                break;
            case 7:
                sim.reset();
                break;
            case 8: {
                auto frame_of = plait_frame_desc_defaults();
                frame_of.felt_translation = 0.5f;
                frame_of.pose.t[0] = 0.02f * static_cast<float>(step);
                sim.set_frame(frame_of);
                break;
            }
            case 9: {
                const auto saved = sim.save();
                sim.restore(saved);
                break;
            }
            default:
                break;
            }
            auto roots = shaken(step);
            roots.scale = seed == 3 ? 1 + 0.1f * static_cast<float>(roll(3)) : 1;
            sim.set_roots(roots);
            sim.step(roll(5) == 0 ? 0.5 * frame : roll(5) == 0 ? 3 * frame : frame);
            EXPECT_EQ(sim.measure().nonfinite, 0u) << "seed " << seed << ", step " << step;
            EXPECT_LT(sim.measure().max_stretch, 1e-3f) << "seed " << seed << ", step " << step;
        }
        return shown(sim);
    };
    for (uint32_t seed = 0; seed < 4; ++seed) {
        const auto x = ride(seed);
        for (const float each : x)
            ASSERT_TRUE(std::abs(each) < 3) << "seed " << seed;
        EXPECT_EQ(x, ride(seed)) << "seed " << seed;
    }
}

// ---- what is refused ----------------------------------------------------------------------------

TEST_P(LevelsInASim, SayWhatIsWrongWithAChoice) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context, 1), none(context, scene.groom);
    const auto says = [](plait::Sim& of, const plait_level_choice& choice, plait_result code,
                         const std::string& sentence) {
        EXPECT_EQ(plait_sim_set_level(of.get(), &choice), code) << sentence;
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
    };
    says(sim, choice_of(0), PLAIT_INVALID_ARGUMENT,
         "choice->level is 0, range is [1, 3], from the sim's level_top on");
    says(sim, choice_of(4), PLAIT_INVALID_ARGUMENT, "choice->level is 4, range is [1, 3]");
    says(sim, choice_of(1, -1), PLAIT_INVALID_ARGUMENT, "choice->blend is -1, range is [0, 5]");
    says(sim, choice_of(1, NAN), PLAIT_INVALID_ARGUMENT, "choice->blend is nan");
    says(sim, choice_of(1, 0, 257), PLAIT_INVALID_ARGUMENT,
         "choice->shown is 257, range is [0, 256]");
    auto restless = choice_of(1);
    restless.rest = 1.5f;
    says(sim, restless, PLAIT_INVALID_ARGUMENT, "choice->rest is 1.5, range is [0, 1]");
    says(none, choice_of(1), PLAIT_INVALID_STATE, "the sim has no levels");
    auto state = plait_level_state_defaults();
    EXPECT_EQ(plait_sim_get_level(none.get(), &state), PLAIT_INVALID_STATE);
    EXPECT_EQ(sim.level().level, 1u);
}

TEST_P(LevelsInASim, SayWhatTheyDoNotGoWith) {
    const Scene scene = hair();
    const plait::Groom other = make_groom(field(15));
    const auto refused = [&](const plait::Groom& groom, const std::string& sentence,
                             const std::function<void(plait_sim_desc&)>& change) {
        auto desc = plait_sim_desc_defaults();
        desc.levels = scene.levels;
        change(desc);
        plait_sim* sim = nullptr;
        EXPECT_EQ(plait_sim_create(context, groom, &desc, &sim), PLAIT_INVALID_ARGUMENT);
        EXPECT_NE(std::string(plait_last_error()).find(sentence), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(sim, nullptr);
    };
    const auto [guides, map] = scene.levels.take(1);
    refused(scene.groom, "desc->levels is given with follows_per_guide, give one",
            [](auto& d) { d.follows_per_guide = 1; });
    refused(guides, "desc->levels is given with follow_map, give one",
            [&](auto& d) { d.follow_map = map; });
    refused(scene.groom, "strands of the model tressfx have no levels",
            [](auto& d) { d.model = PLAIT_MODEL_TRESSFX; });
    refused(scene.groom, "desc->level_top is 4, range is [0, 3]", [](auto& d) { d.level_top = 4; });
    refused(scene.groom, "desc->level_top is 3, a level without guides",
            [](auto& d) { d.level_top = 3; });
    refused(scene.groom, "desc->level_top is 1 and levels is NULL", [](auto& d) {
        d.levels = nullptr;
        d.level_top = 1;
    });
    refused(other, "desc->levels are of another groom", [](auto&) {});
}

TEST_P(LevelsInASim, WakeStrandsThatWereNotShownWhereTheyWouldHaveBeen) {
    const Scene scene = hair();
    for (const uint32_t level : {2u, 3u}) {
        plait::Sim few = scene.sim(context), all = scene.sim(context);
        few.set_level(choice_of(level, 0, 8));
        all.set_level(choice_of(level, 0));
        for (int step = 0; step < 60; ++step) {
            move(few, step);
            move(all, step);
        }
        few.set_level(choice_of(0, 0));
        all.set_level(choice_of(0, 0));
        for (int step = 60; step < 63; ++step) {
            move(few, step);
            move(all, step);
        }
        EXPECT_EQ(shown(few), shown(all)) << "from level " << level;
    }
}

TEST_P(LevelsInASim, GoRigidWithTheirDetailAndOnBodies) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context, 1);
    auto detail = plait_detail_desc_defaults();
    for (int i = 1; i < 4; ++i)
        detail.clump[i] = 0.8f;
    sim.set_detail(detail);
    auto body = smooth_collider();
    body.capsule.radius_a = body.capsule.radius_b = 0.05f;
    body.pose.t[0] = body.pose.t[2] = 0.04f;
    body.pose.t[1] = -0.1f;
    sim.create_collider(body);
    for (int step = 0; step < 240; ++step)
        move(sim, 0, 0);
    for (const uint32_t level : {3u, 1u}) {
        const auto before = shown(sim);
        sim.set_level(choice_of(level));
        for (int step = 0; step < 3; ++step)
            move(sim, 0, 0);
        EXPECT_LT(rms(before, shown(sim), scene.row, 0, scene.strands), 3e-4) << level;
    }
}

} // namespace
