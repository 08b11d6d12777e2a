// Motions by name and from files.
#include "scene/motion.hpp"
#include "common.hpp"
#include "support.hpp"

#include <gmock/gmock.h>

#include <cmath>

using simulate::HeadState;
using simulate::make_motion;
using testing::HasSubstr;

namespace {

class MotionFile : public TemporaryFolder {
  protected:
    std::string refusal(const std::string& name, const std::string& text) const {
        return refusal_of([&] { make_motion(write(name, text)); });
    }
};

TEST(Motion, named_ones_start_at_rest_and_do_not_jump) {
    for (const char* name : {"still", "shake", "turn", "nod", "shake_and_turn", "walk"}) {
        const auto motion = make_motion(name);
        HeadState before = motion->at(0.0f);
        EXPECT_NEAR(std::abs(before.yaw) + std::abs(before.pitch) + std::abs(before.y), 0.0f, 1e-5f)
            << name;
        for (int frame = 1; frame <= 600; ++frame) {
            const HeadState now = motion->at(static_cast<float>(frame) / 60.0f);
            EXPECT_LT(std::abs(now.yaw - before.yaw), 8.0f) << name << " at frame " << frame;
            before = now;
        }
    }
}

TEST(Motion, unknown_name_gets_the_nearest) {
    try {
        make_motion("shakes");
        FAIL();
    } catch (const simulate::Failure& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("the nearest is \"shake\""));
    }
}

TEST_F(MotionFile, csv_goes_through_its_keyframes) {
    const auto motion =
        make_motion(write("m.csv", "# comment\ntime, yaw, x\n0, 0, 0\n1, 30, 0.1\n2, 0, 0.2\n"));
    EXPECT_NEAR(motion->at(1.0f).yaw, 30.0f, 1e-4f);
    EXPECT_NEAR(motion->at(1.0f).x, 0.1f, 1e-6f);
    EXPECT_NEAR(motion->at(-1.0f).yaw, 0.0f, 1e-6f); // held before and after
    EXPECT_NEAR(motion->at(5.0f).x, 0.2f, 1e-6f);
    // Slopes: 30 degrees/s x 0.5 at the start (held before), 0 at the peak: Hermite at the middle.
    EXPECT_NEAR(motion->at(0.5f).yaw, 0.5f * 30.0f + 0.125f * 15.0f, 1e-3f);
}

TEST_F(MotionFile, json_says_the_same_as_csv) {
    const auto csv = make_motion(write("m.csv", "time,pitch\n0,0\n0.5,10\n2,-4\n"));
    const auto json =
        make_motion(write("m.json", R"({"keyframes": [{"time": 0}, {"time": 0.5, "pitch": 10},
                                                     {"time": 2, "pitch": -4}]})"));
    for (float time = 0.0f; time < 2.5f; time += 0.1f)
        EXPECT_FLOAT_EQ(csv->at(time).pitch, json->at(time).pitch);
}

TEST_F(MotionFile, mistakes_are_placed) {
    EXPECT_THAT(refusal("m.csv", "time,yaw\n0,0\n1,abc\n"), HasSubstr("m.csv:3: \"abc\""));
    EXPECT_THAT(refusal("m.csv", "time,yow\n0,0\n"), HasSubstr("m.csv:1: column \"yow\""));
    EXPECT_THAT(refusal("m.csv", "#\ntime,yaw,yaw\n0,1,2\n"),
                HasSubstr("m.csv:2: column \"yaw\" stands here twice"));
    EXPECT_THAT(refusal("m.csv", "time,yaw\n0\n"), HasSubstr("m.csv:2: 1 values"));
    EXPECT_THAT(refusal("m.csv", "time,yaw\n1,0\n1,5\n"), HasSubstr("keyframe 1"));
    EXPECT_THAT(refusal("m.csv", "time,yaw\n"), HasSubstr("no keyframes"));
    EXPECT_THAT(refusal("m.json", R"({"keyframes": [{"yaw": 3}]})"),
                HasSubstr("keyframes[0].time is missing"));
}

TEST(Motion, poses_turn_about_the_pivot) {
    HeadState head;
    head.yaw = 90.0f;
    head.y = 0.5f;
    const plait_pose pose = simulate::to_pose(head, {1.0f, 2.0f, 3.0f});
    // Ry(90): (x, y, z) -> (z, y, -x); t = pivot + move - R pivot
    EXPECT_NEAR(pose.q[1], std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(pose.t[0], 1.0f - 3.0f, 1e-5f);
    EXPECT_NEAR(pose.t[1], 0.5f, 1e-5f);
    EXPECT_NEAR(pose.t[2], 3.0f + 1.0f, 1e-5f);
}

} // namespace
