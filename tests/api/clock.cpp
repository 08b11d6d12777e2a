// Time: fixed steps out of whatever the caller's frames are.
#include "support.hpp"

namespace {

const std::string reference = "reference";

TEST(Clock, ManyCallsOfExactlyOneStepAreThatManySteps) {
    const auto context = make_context(reference);
    for (const float step : {1.0f / 60, 1.0f / 144, 1.0f / 90, 0.01f}) {
        plait::SimDesc desc;
        desc.step = step;
        for (const double dt : {double(step), 1 / std::round(1 / double(step))}) {
            plait::Sim sim(context, make_groom(tuft(1, 3)), desc);
            for (int i = 1; i <= 300; ++i) {
                sim.step(dt);
                ASSERT_EQ(sim.describe().steps, static_cast<uint64_t>(i)) << step << ' ' << dt;
            }
        }
    }
}

TEST(Clock, JitterInFrameTimesDoesNotChangeTheMotion) {
    const auto context = make_context(reference);
    const auto groom = make_groom(tuft(3, 8));
    plait::SimDesc desc;
    desc.interpolate_output = 0; // the motion, whatever is shown of it
    plait::Sim regular(context, groom, desc);
    plait::Sim jittered(context, groom, desc);
    run(regular, 60);
    for (int i = 0; i < 30; ++i) {
        jittered.step(frame * 1.6);
        jittered.step(frame * 0.4);
    }
    EXPECT_EQ(jittered.describe().steps, 60u);
    EXPECT_EQ(regular.read(PLAIT_FIELD_POSITION), jittered.read(PLAIT_FIELD_POSITION));
}

TEST(Clock, RootsMovingSteadilyAreSampledAtTheStepsOwnTimes) {
    const auto context = make_context(reference);
    const auto groom = make_groom(tuft(2, 8));
    plait::SimDesc desc;
    desc.interpolate_output = 0;
    plait::Sim regular(context, groom, desc);
    plait::Sim jittered(context, groom, desc);
    const auto head = [](double t) { return head_at({static_cast<float>(0.5 * t), 0, 0}); };
    regular.set_roots(head(0)); // where they are
    jittered.set_roots(head(0));
    for (int i = 1; i <= 60; ++i) {
        regular.set_roots(head(i * frame));
        regular.step(frame);
    }
    double t = 0;
    for (int i = 0; i < 60; ++i) {
        const double dt = frame * (i % 3 == 0 ? 2.2 : 0.4);
        t += dt;
        jittered.set_roots(head(t));
        jittered.step(dt);
    }
    EXPECT_EQ(jittered.describe().steps, 60u);
    EXPECT_LT(
        largest_difference(regular.read(PLAIT_FIELD_POSITION), jittered.read(PLAIT_FIELD_POSITION)),
        2e-6f); // m; one step's motion is 8e-3
}

TEST(Clock, TimeBeyondTheLimitIsDroppedAndCounted) {
    const auto context = make_context(reference);
    plait::Sim sim(context, make_groom(tuft(1, 4)));
    sim.step(1.0);
    EXPECT_EQ(sim.describe().steps, 8u);
    EXPECT_EQ(sim.describe().steps_dropped, 52u);
}

TEST(Clock, OutputFollowsTimeBetweenSteps) {
    const auto context = make_context(reference);
    plait::SimDesc desc;
    desc.interpolate_output = 1;
    const auto groom = make_groom(tuft(1, 8));
    plait::Sim shown(context, groom, desc);
    plait::Sim plain(context, groom);
    run(shown, 10);
    run(plain, 9);
    const auto before = plain.read(PLAIT_FIELD_POSITION);
    run(plain, 1);
    const auto after = plain.read(PLAIT_FIELD_POSITION);
    shown.step(frame * 0.25);
    const auto between = shown.read(PLAIT_FIELD_POSITION);
    ASSERT_GT(largest_difference(before, after), 1e-3f);
    // in the direction of what lies a quarter of the way, at a quarter of the way's distance from the root
    for (size_t tip = 4; tip < before.size(); tip += 4) {
        double way[3], chord = 0, a = 0, b = 0;
        for (size_t k = 0; k < 3; ++k) {
            const double from = double(before[tip + k]) - double(before[k]);
            const double to = double(after[tip + k]) - double(after[k]);
            way[k] = 0.75 * from + 0.25 * to;
            chord += way[k] * way[k];
            a += from * from;
            b += to * to;
        }
        const double stretch = (0.75 * std::sqrt(a) + 0.25 * std::sqrt(b)) / std::sqrt(chord);
        EXPECT_GT(stretch, 1);
        for (size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(between[tip + k], between[k] + stretch * way[k], 1e-6) << tip / 4;
    }
}

} // namespace
