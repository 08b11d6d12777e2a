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
