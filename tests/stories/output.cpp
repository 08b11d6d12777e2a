// Frames need not end where steps do: what is drawn lies on the head as it is drawn.
#include "story.hpp"

using namespace story;

TEST(Output, roots_are_on_the_head_in_every_frame) {
    const plait::Context context;
    plait::Sim sim(context, hair(down)); // steps of 1/60 s
    float before = 0;
    for (int frame = 1; frame <= 300; ++frame) {
        const float head = 0.02f * static_cast<float>(frame); // 1 m/s at 50 frames a second
        sim.set_roots(head_at({head, 0, 0}));
        sim.step(1.0 / 50);
        EXPECT_LT(distance(vertex(sim, 0, 0), {head, 0, 0}), 5e-4f) << "frame " << frame;
        const float tip_now = tip_of(sim)[0];
        if (frame > 250) {
            EXPECT_NEAR(tip_now - before, 0.02f, 0.01f) << "no frame stands still, frame " << frame;
        }
        before = tip_now;
    }
}
