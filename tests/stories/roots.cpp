// Roots go where the head is. Between two frames they move; a teleport takes the hair along at once.
#include "story.hpp"

using namespace story;

TEST(Roots, pull_hair_along_where_they_move) {
    const plait::Context context;
    plait::Sim sim(context, hair(down));
    pass(sim, 0.5);
    sim.set_roots(head_at({0.1f, 0, 0}));
    sim.step(1.0 / 60);
    EXPECT_NEAR(vertex(sim, 0, 0)[0], 0.1f, 1e-6f);
    EXPECT_LT(tip_of(sim)[0], 0.05f) << "the tip lags behind";
}

TEST(Roots, take_hair_along_where_they_are_teleported) {
    const plait::Context context;
    plait::Sim sim(context, hair(down));
    pass(sim, 0.5);
    sim.teleport(head_at({100, 0, 0}));
    pass(sim, 0.5);
    EXPECT_LT(distance(tip_of(sim), {100, -length, 0}), 1e-3f) << "and nothing swings";
}
