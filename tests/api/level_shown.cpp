// What is drawn of a sim whose level changes, frame by frame: motion vectors, hair between steps, and hair
// beside a body.
#include "level_scenes.hpp"

#include <functional>
#include <memory>

namespace {

class LevelShown : public OnBackend {};
ON_EVERY_BACKEND(LevelShown);

// A ball among the hair, which it keeps where guides alone would not have it.
void add_ball(plait::Sim& sim) {
    auto ball = smooth_collider();
    ball.capsule.radius_a = ball.capsule.radius_b = 0.03f;
    for (float* end : {ball.capsule.a, ball.capsule.b})
        std::ranges::copy(Point{0.1f, -0.04f, 0.04f}, end);
    sim.create_collider(ball);
}

std::vector<float> last_frame(const plait::Sim& sim) {
    return sim.read(PLAIT_FIELD_POSITION_LAST_FRAME);
}

// ---- the frame before ---------------------------------------------------------------------------

// Of strands that come into view it is as if they had been in view all along.
TEST_P(LevelShown, TheFrameBeforeHasWhatComesIntoView) {
    struct Case {
        const char* name;
        plait_level_choice from, to; // shown of `from` is of the sim that shows few
        float call;                  // frames
        float scale = 1;
        bool interpolates = false, meets_ball = true;
    };
    const Case cases[] = {
        {"finer", choice_of(2, 0.3f, 32), choice_of(0), 1},
        {"finer, four steps in a call", choice_of(2, 0.3f, 32), choice_of(0), 4},
        {"finer, some", choice_of(2, 0.3f, 32), choice_of(1, 0.3f, 128), 1},
        {"finer, in another size", choice_of(2, 0.3f, 32), choice_of(0), 1, 2},
        {"finer, between steps", choice_of(2, 0.3f, 32), choice_of(0), 0.53f, 1, true},
        {"coarser", choice_of(1, 0.3f, 64), choice_of(2), 1},
        {"of the same level", choice_of(2, 0.3f, 32), choice_of(2), 1},
        {"of the same level, between steps", choice_of(2, 0.3f, 32), choice_of(2), 0.53f, 1, true},
        {"out of rest", choice_of(3, 0, 32), choice_of(1), 1},
        {"without a body", choice_of(2, 0, 32), choice_of(0, 0), 1, 1, false, false},
    };
    const Scene scene = hair();
    for (const Case& c : cases) {
        const auto sim_that_shows = [&](uint32_t shown) {
            plait::Sim sim = scene.sim(context, 0, [&](auto& desc) {
                desc.keep_last_frame = 1;
                desc.interpolate_output = c.interpolates;
            });
            if (c.meets_ball)
                add_ball(sim);
            auto choice = c.from;
            choice.shown = shown;
            sim.set_level(choice);
            return sim;
        };
        plait::Sim few = sim_that_shows(c.from.shown), all = sim_that_shows(0);
        int call = 0;
        const auto pass = [&] {
            ++call;
            for (plait::Sim* sim : {&few, &all}) {
                auto roots = shaken(double(c.call) * call);
                roots.scale = c.scale;
                sim->set_roots(roots);
                sim->step(double(c.call) * slightly_more);
            }
        };
        for (int i = 0; i < 40; ++i)
            pass();
        for (plait::Sim* sim : {&few, &all})
            sim->set_level(c.to);
        auto before = shown(all);
        const float stale = largest_difference(before, shown(few));
        EXPECT_GT(stale, 1e-2f) << c.name;
        const size_t count = 4 * scene.row * (c.to.shown > 0 ? c.to.shown : scene.strands);
        for (int i = 0; i < 5; ++i) {
            pass();
            const auto a = last_frame(few), b = shown(few), expected = shown(all);
            // of 0.2 m; what is kept in a size of its own is rounded once more
            for (size_t k = 0; few.level().shown == all.level().shown && k < count; ++k) {
                ASSERT_NEAR(a[k], before[k], 1e-7f * c.scale)
                    << c.name << ", call " << i << ", strand " << k / 4 / scene.row;
                ASSERT_NEAR(b[k], expected[k], 1e-7f * c.scale)
                    << c.name << ", call " << i << ", strand " << k / 4 / scene.row;
            }
            before = expected; // the first call between steps may make none
        }
        EXPECT_EQ(few.level().shown, all.level().shown) << c.name;
    }
}

// Nothing more is in view before the step that places it.
TEST_P(LevelShown, ComesIntoViewWithAStep) {
    const Scene scene = hair();
    plait::Sim sim = scene.sim(context, 0, [](auto& desc) { desc.interpolate_output = 0; });
    move(sim, 0);
    sim.set_level(choice_of(2, 0, 32));
    move(sim, 1);
    ASSERT_EQ(sim.level().shown, 32u);
    const auto before = shown(sim);
    sim.set_level(choice_of(2));
    EXPECT_EQ(sim.level().shown, 32u);
    sim.step(0.1 * frame); // without a fixed step
    EXPECT_EQ(sim.level().shown, 32u);
    EXPECT_EQ(shown(sim), before);
    move(sim, 2);
    EXPECT_EQ(sim.level().shown, 256u);
}

// ---- between steps ------------------------------------------------------------------------------

// A sim that changes its level, and one that does not; at any times, at which hair is shown between steps.
class BetweenSteps {
  public:
    enum class Ball { none, with_head, still };
    static constexpr double begin = 0.05; // steps

    // At `level`, to which they go over 4 steps before the end, in `blend` s.
    BetweenSteps(const plait::Context& context, const Scene& scene, Ball ball, uint32_t before,
                 uint32_t level, float blend)
        : steady(made(context, scene, ball)), sim(made(context, scene, ball)), ball_(ball) {
        set_level(choice_of(before, 0));
        pass(begin);
        for (int i = 0; i < 40; ++i) {
            if (i == 36)
                set_level(choice_of(level, blend));
            pass(1);
        }
    }
    plait::Sim steady, sim;
    void pass(double steps) {
        time_ += steps;
        for (plait::Sim* each : {&steady, &sim}) {
            const plait_roots roots = shaken(time_);
            each->set_roots(roots);
            if (ball_ == Ball::with_head)
                each->set_collider_pose(each->colliders().front(), roots.head);
            each->step(steps * frame);
        }
    }

  private:
    static plait::Sim made(const plait::Context& context, const Scene& scene, Ball ball) {
        plait::Sim made = scene.sim(context, 0, [](auto& desc) { desc.interpolate_output = 1; });
        if (ball != Ball::none)
            add_ball(made);
        return made;
    }
    void set_level(const plait_level_choice& choice) {
        steady.set_level(choice);
        sim.set_level(choice);
    }

    Ball ball_;
    double time_ = 0; // steps
};

// The frame of a switch is as without one; then hair moves by no more, within the step and over its end.
TEST_P(LevelShown, GoesOnBetweenStepsFromWhereItWas) {
    using Ball = BetweenSteps::Ball;
    struct Case {
        uint32_t before, from, to;
        float blend; // to `from`, which has not ended
        Ball ball;
    };
    const Scene scene = hair();
    for (const Case& c : {Case{2, 2, 0, 0, Ball::none},
                          {2, 2, 0, 0, Ball::with_head},
                          {2, 2, 1, 0, Ball::with_head},
                          {1, 2, 0, 0.3f, Ball::with_head},
                          {1, 3, 1, 0, Ball::with_head},
                          {0, 0, 2, 0, Ball::with_head},
                          {1, 1, 3, 0, Ball::with_head},
                          {2, 2, 0, 0, Ball::still},
                          {1, 2, 0, 0.3f, Ball::still},
                          {0, 0, 2, 0, Ball::still}})
        for (const double at : {0.05, 0.5, 0.9}) { // of a step, where the switch is
            BetweenSteps both(context, scene, c.ball, c.before, c.from, c.blend);
            both.sim.set_level(choice_of(c.to));
            const auto says = [&](double steps) {
                return testing::Message() << c.before << ", " << c.from << " to " << c.to << " at "
                                          << at << ", ball " << int(c.ball) << ", after " << steps;
            };
            both.pass(1 + at - BetweenSteps::begin);
            EXPECT_LT(largest_difference(shown(both.sim), shown(both.steady)), 1e-3f) << says(0);
            for (const double steps : {0.98 - at, 0.04, 0.04, 0.5}) {
                const auto own = shown(both.sim), steady = shown(both.steady);
                both.pass(steps);
                const float most = largest_difference(steady, shown(both.steady));
                if (c.ball == Ball::still)
                    continue; // of which follows are turned to this side and that
                EXPECT_LT(largest_difference(own, shown(both.sim)), most + 1e-3f) << says(steps);
            }
        }
}

} // namespace
