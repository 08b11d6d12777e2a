// The default model: hair swings as a hanging chain does, and keeps its length whatever the head does.
#include "story.hpp"

using namespace story;

// A limp chain of length L swings with the frequency 1.2024 sqrt(g/L)/2 pi: 1.095 Hz. The default hair is
// a little stiff.
TEST(Strands, swing_as_fast_as_a_chain) {
    const plait::Context context;
    plait::SimDesc desc;
    desc.params.drag = 0; // 1/s
    plait::Sim sim(context, hair({0.05f, -0.99875f, 0}), desc);
    int crossings = 0;
    for (float before = tip_of(sim)[0]; sim.describe().steps < 600;) {
        sim.step(1.0 / 60);
        const float now = tip_of(sim)[0];
        crossings += before < 0 && now >= 0;
        before = now;
    }
    EXPECT_NEAR(crossings / 10.0, 1.1, 0.11);
}

TEST(Strands, keep_their_length_on_a_head_that_shakes) {
    const plait::Context context;
    plait::Sim sim(context, hair(down));
    for (int frame = 1; frame <= 120; ++frame) {
        sim.set_roots(head_at({0.1f * std::sin(0.3f * static_cast<float>(frame)), 0, 0}));
        sim.step(1.0 / 60);
        EXPECT_LT(sim.measure().max_stretch, 1e-5f);
    }
}
