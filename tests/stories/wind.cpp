// Wind bends hair; behind a ball the air is calm.
#include "story.hpp"

using namespace story;

TEST(Wind, a_strand_behind_a_ball_is_calm) {
    const plait::Context context;
    plait::Sim sim(context, hairs({{0, 0, 0}, {0.5f, 0, 0}}, down));
    auto ball = plait_collider_desc_defaults();
    ball.capsule.radius_a = ball.capsule.radius_b = 0.15f;
    ball.pose.t[1] = -0.15f;
    ball.pose.t[2] = -0.2f; // up the wind of the first strand
    sim.create_collider(ball);
    auto wind = plait_wind_desc_defaults();
    wind.velocity[2] = 5; // m/s
    sim.set_wind(wind);
    pass(sim, 3);
    EXPECT_GT(tip_of(sim, 1)[2], 0.05f) << "in the open";
    EXPECT_LT(std::abs(tip_of(sim, 0)[2]), tip_of(sim, 1)[2] / 3);
}
