// Hair meets bodies: it falls on a ball, lies on it and does not sink in; with friction it stays there.
#include "story.hpp"

using namespace story;

TEST(Contact, hair_lies_on_a_ball) {
    const plait::Context context;
    plait::Sim sim(context, hair(level));
    auto ball = plait_collider_desc_defaults(); // a capsule whose ends are one point
    ball.capsule.radius_a = ball.capsule.radius_b = 0.1f;
    ball.friction = 0.3f;
    ball.pose.t[0] = 0.1f;
    ball.pose.t[1] = -0.12f;
    sim.create_collider(ball);
    pass(sim, 3);
    int lie = 0;
    for (std::uint32_t i = 1; i < vertices; ++i) {
        const float outside = distance(vertex(sim, 0, i), {0.1f, -0.12f, 0}) - 0.1f;
        EXPECT_GT(outside, -5e-4f) << "vertex " << i;
        lie += outside < 1e-3f;
    }
    EXPECT_GE(lie, 3);
}

// A beard meets the ball that was made for the hair, and moves with it by the one call.
TEST(Contact, hair_and_beard_share_a_ball) {
    const plait::Context context;
    plait::Sim long_hair(context, hair(level)), beard(context, hair(level)),
        alone(context, hair(level));
    beard.share_colliders(long_hair);
    auto ball = plait_collider_desc_defaults();
    ball.pose.t[0] = 0.1f;
    ball.pose.t[1] = -0.12f;
    const auto id = long_hair.create_collider(ball);
    for (int frame = 0; frame < 180; ++frame) {
        ball.pose.t[1] += 0.0004f;
        long_hair.set_collider_pose(id, ball.pose);
        context.step({long_hair, beard, alone}, 1.0 / 60);
    }
    const Point middle{ball.pose.t[0], ball.pose.t[1], 0};
    EXPECT_EQ(tip_of(beard), tip_of(long_hair)) << "they are the same hair on the same ball";
    for (std::uint32_t i = 1; i < vertices; ++i)
        EXPECT_GT(distance(vertex(beard, 0, i), middle), 0.0995f) << "vertex " << i;
    EXPECT_GT(tip_of(beard)[1] - tip_of(alone)[1], 0.05f) << "the ball has lifted it";
}
