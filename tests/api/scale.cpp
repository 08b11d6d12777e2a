// Hair that is larger or smaller than its groom: what keeps its shape, what goes along, what is refused.
#include "scale_scenes.hpp"

#include <algorithm>
#include <limits>

namespace {

using namespace scaled;

class Scale : public OnBackend {};
ON_EVERY_BACKEND(Scale);

void add_wind(plait::Sim& sim, plait_model model) {
    if (model == PLAIT_MODEL_TRESSFX) {
        auto desc = plait_tressfx_desc_defaults();
        desc.wind[0] = -0.5f;
        desc.wind[2] = 0.8f;
        sim.set_tressfx(&desc);
        return;
    }
    auto wind = plait_wind_desc_defaults();
    wind.velocity[0] = -0.5f;
    wind.velocity[2] = 0.8f;
    sim.set_wind(wind);
}

TEST_P(Scale, AtRestHairHasTheSameShape) {
    for (const plait_model model : models) {
        std::vector<float> expected;
        for (const float scale : {1.0f, 0.1f, 8.0f}) {
            Scene scene(context, model, scale);
            scene.move_away();
            scene.sim.create_collider(ball(scene.at));
            add_wind(scene.sim, model);
            run(scene.sim, 150);
            const auto hair = scene.hair();
            if (scale == 1)
                expected = hair;
            EXPECT_LT(largest_difference(hair, expected), 1e-4f * length)
                << "model " << model << " at " << scale;
            EXPECT_FLOAT_EQ(scene.sim.describe().scale, scale);
        }
    }
}

// The grid, volume and eddies go along; the eddies' places are the groom's, too.
TEST_P(Scale, GridAndAirGoAlong) {
    std::vector<float> expected;
    for (const float scale : {1.0f, 4.0f}) {
        Scene scene(context, PLAIT_MODEL_ARTICULATED, scale,
                    [](plait::SimDesc& desc) { desc.grid.on = true; });
        auto wind = plait_wind_desc_defaults();
        wind.velocity[2] = 1;
        scene.sim.set_wind(wind);
        run(scene.sim, 40);
        if (scale == 1)
            expected = scene.hair();
        EXPECT_LT(largest_difference(scene.hair(), expected), 1e-4f * length) << scale;
    }
}

TEST_P(Scale, AHeadThatMovesSoManyTimesAsFarMovesHairAlike) {
    const auto at = [](int step, float scale) {
        const float angle = 0.12f * static_cast<float>(step);
        return Point{scale * 0.06f * std::sin(angle), scale * 0.03f * (1 - std::cos(angle)), 0};
    };
    for (const plait_model model : models) {
        Scene one(context, model, 1), other(context, model, 8);
        for (Scene* scene : {&one, &other}) {
            scene->at = at(0, scene->scale);
            scene->sim.teleport(roots_at(scene->scale, scene->at));
            scene->sim.create_collider(ball(scene->at));
        }
        for (int step = 0; step < 60; ++step) {
            for (Scene* scene : {&one, &other}) {
                scene->at = at(step, scene->scale);
                scene->sim.set_roots(roots_at(scene->scale, scene->at));
                for (const plait_collider_id id : scene->sim.colliders())
                    scene->sim.set_collider_pose(id, pose_at(scene->at));
                scene->sim.step(frame);
            }
            ASSERT_LT(largest_difference(one.hair(), other.hair()), 2e-5f)
                << "model " << model << ", step " << step;
        }
        const auto slow = one.sim.read(PLAIT_FIELD_VELOCITY);
        auto fast = other.sim.read(PLAIT_FIELD_VELOCITY);
        for (float& v : fast)
            v /= 8;
        EXPECT_LT(largest_difference(slow, fast), 2e-3f);
        EXPECT_NEAR(other.sim.measure().max_speed / 8, one.sim.measure().max_speed, 2e-3f);
    }
}

// At once, and over half a second, in the air and on a body; beside hair whose scale stays.
TEST_P(Scale, ChangesWithoutAJump) {
    for (const plait_model model : models)
        for (const bool body : {false, true})
            for (const int frames : {1, 30}) {
                Scene scene(context, model, 1), stays(context, model, 1);
                for (Scene* each : {&scene, &stays}) {
                    if (body)
                        each->sim.create_collider(ball());
                    run(each->sim, 90);
                }
                for (int step = 1; step <= frames + (body ? 0 : 20); ++step) {
                    if (step <= frames)
                        scene.resize(1 + static_cast<float>(step) / static_cast<float>(frames));
                    scene.sim.step(frame);
                    stays.sim.step(frame);
                    // on a body hair still slides, and what is rounded anew tells later
                    ASSERT_LT(largest_difference(scene.hair(), stays.hair()), body ? 2e-5f : 1e-5f)
                        << "model " << model << ", " << frames << " frames, step " << step;
                    const auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
                    const auto rest = scene.sim.read(PLAIT_FIELD_REST);
                    for (size_t strand = 0; strand < strands; ++strand)
                        for (size_t k = 0; k < 3; ++k) {
                            const size_t root = 4 * vertices * strand + k;
                            ASSERT_NEAR(hair[root], place[k] + scene.scale * rest[root], 1e-6f);
                        }
                }
            }
}

TEST_P(Scale, ATeleportAndAStepOfNoTimeTakeItAtOnce) {
    for (const plait_model model : models) {
        Scene scene(context, model, 1);
        run(scene.sim, 30);
        const auto before = scene.hair();
        scene.scale = 3;
        scene.at = {-7, 2, 5};
        scene.sim.teleport(roots_at(3, scene.at));
        EXPECT_LT(largest_difference(scene.hair(), before), 2e-6f);
        EXPECT_EQ(scene.sim.read(PLAIT_FIELD_POSITION),
                  scene.sim.read(PLAIT_FIELD_POSITION_LAST_FRAME));
        scene.resize(0.5f);
        scene.sim.step(0);
        EXPECT_LT(largest_difference(scene.hair(), before), 4e-6f);
    }
}

// A twentieth of the frames end between two steps.
TEST_P(Scale, HairBetweenStepsHasThePresentScale) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1);
    for (int step = 1; step <= 40; ++step) {
        scene.resize(1 + 0.02f * static_cast<float>(step));
        scene.sim.step(0.7 * frame);
        const auto hair = scene.hair();
        const auto rest = scene.sim.read(PLAIT_FIELD_REST);
        for (size_t strand = 0; strand < strands && step > 1; ++strand)
            for (size_t k = 0; k < 3; ++k)
                ASSERT_NEAR(hair[4 * vertices * strand + k], rest[4 * vertices * strand + k], 1e-6f)
                    << step;
    }
}

TEST_P(Scale, PinsInTheWorldAreWhereTheyAre) {
    for (const float scale : {1.0f, 4.0f}) {
        Scene scene(context, PLAIT_MODEL_ARTICULATED, scale, [](plait::SimDesc&) {});
        plait_pin pin{};
        pin.vertex = vertices - 1;
        pin.frame = PLAIT_PIN_FRAME_WORLD;
        pin.stiffness = PLAIT_PIN_HELD;
        const Point hand = {place[0] + 0.1f * scale, place[1] + 0.05f * scale, place[2]};
        std::ranges::copy(hand, pin.target);
        scene.sim.set_pins({pin});
        run(scene.sim, 60);
        const auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
        for (size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(hair[4 * (vertices - 1) + k], hand[k], 1e-3f * scale);
    }
}

// A train that brakes, and is not felt.
TEST_P(Scale, AFrameCarriesHairAtAnyScale) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1), stays(context, PLAIT_MODEL_ARTICULATED, 1);
    auto train = plait_frame_desc_defaults();
    run(stays.sim, 30);
    for (int step = 0; step < 30; ++step) {
        scene.sim.set_frame(train);
        scene.sim.step(frame);
    }
    float way = 0;
    for (int step = 1; step <= 30; ++step) {
        way += 0.01f * static_cast<float>(step % 10);
        scene.at[0] = place[0] + way;
        train.pose = pose_at({way, 0, 0});
        if (step % 2)
            scene.sim.set_frame(train);
        scene.resize(step < 10 ? 1 : 3);
        if (step % 2 == 0)
            scene.sim.set_frame(train);
        scene.sim.step(frame);
        stays.sim.step(frame);
        ASSERT_LT(largest_difference(scene.hair(), stays.hair()), 2e-5f) << step;
    }
}

TEST_P(Scale, WhatIsReadMayBeWritten) {
    for (const plait_model model : models) {
        Scene scene(context, model, 3);
        run(scene.sim, 10);
        const auto state = scene.sim.save();
        const auto before = scene.sim.hash();
        auto hair = scene.sim.read(PLAIT_FIELD_POSITION);
        hair.resize(4 * strands * vertices);
        scene.sim.write(PLAIT_FIELD_POSITION, hair);
        scene.sim.write(PLAIT_FIELD_POSITION_PREV, scene.sim.read(PLAIT_FIELD_POSITION_PREV));
        if (model == PLAIT_MODEL_TRESSFX) { // others find velocities again but for rounding
            EXPECT_EQ(scene.sim.hash(), before);
        }
        hair[4 * 5] += 0.3f; // m, a vertex put elsewhere
        scene.sim.write(PLAIT_FIELD_POSITION, hair);
        EXPECT_NEAR(scene.sim.read(PLAIT_FIELD_POSITION)[4 * 5], hair[4 * 5], 1e-6f);
        const std::vector<float> velocity(4 * strands * vertices, 1.5f);
        scene.sim.write(PLAIT_FIELD_VELOCITY, velocity);
        const auto moves = scene.sim.read(PLAIT_FIELD_VELOCITY);
        for (size_t i = 0; i < velocity.size(); ++i)
            EXPECT_NEAR(moves[i], i % 4 < 3 ? 1.5f : 0.0f, 2e-3f);
        const auto box = scene.sim.read(PLAIT_FIELD_BOUNDS);
        const auto now = scene.sim.read(PLAIT_FIELD_POSITION);
        float greatest = now[0];
        for (size_t i = 0; i < now.size(); i += 4)
            greatest = std::max(greatest, now[i]);
        EXPECT_EQ(box[4], greatest);
        scene.sim.restore(state);
        EXPECT_EQ(scene.sim.hash(), before);
    }
}

TEST_P(Scale, GoesOnFromASnapshot) {
    for (const plait_model model : models) {
        Scene scene(context, model, 1);
        scene.sim.create_collider(ball());
        run(scene.sim, 20);
        scene.resize(0.25f);
        run(scene.sim, 5);
        const auto state = scene.sim.save();
        Scene other(context, model, 1);
        other.scale = 0.25f;
        other.sim.restore(state);
        EXPECT_EQ(other.sim.describe().scale, 0.25f);
        EXPECT_EQ(other.sim.hash(), scene.sim.hash());
        run(scene.sim, 5);
        run(other.sim, 5);
        if (GetParam() == "reference") { // in float64, of which snapshots hold float32
            EXPECT_LT(largest_difference(other.hair(), scene.hair()), 1e-5f);
            continue;
        }
        EXPECT_EQ(other.sim.read(PLAIT_FIELD_POSITION), scene.sim.read(PLAIT_FIELD_POSITION));
        EXPECT_EQ(other.sim.hash(), scene.sim.hash());
    }
}

TEST_P(Scale, OfOneTakesNoStageAndAnotherOne) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 1,
                [](plait::SimDesc& desc) { desc.keep_last_frame = 0; });
    const auto has = [&] {
        for (const auto& [stage, calls] : stages_of(scene.sim))
            if (stage == "last_frame" && calls > 0)
                return true;
        return false;
    };
    EXPECT_FALSE(has());
    scene.resize(2);
    EXPECT_TRUE(has());
}

TEST_P(Scale, WhatIsNoneIsRefused) {
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 2);
    run(scene.sim, 3);
    const auto before = scene.sim.hash();
    for (const float scale : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(), 9e-4f, 1001.0f}) {
        const auto roots = roots_at(scale);
        EXPECT_EQ(plait_sim_set_roots(scene.sim.get(), &roots), PLAIT_INVALID_ARGUMENT) << scale;
        EXPECT_NE(std::string(plait_last_error()).find("roots->scale is"), std::string::npos)
            << plait_last_error();
        EXPECT_EQ(plait_sim_teleport(scene.sim.get(), &roots), PLAIT_INVALID_ARGUMENT) << scale;
        auto body = ball();
        body.scale = scale;
        plait_collider_id id{};
        if (scale != 0) {
            EXPECT_EQ(plait_collider_create(scene.sim.get(), &body, &id), PLAIT_INVALID_ARGUMENT);
            EXPECT_NE(std::string(plait_last_error()).find("scale is"), std::string::npos);
        }
    }
    EXPECT_EQ(scene.sim.hash(), before) << "what is refused changes nothing";
}

} // namespace
