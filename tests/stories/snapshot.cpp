// A sim is saved, goes on, and is restored: what follows is the same to the last bit.
#include "story.hpp"

using namespace story;

TEST(Snapshot, replays_to_the_same_bits) {
    const plait::Context context;
    plait::Sim sim(context, hair(level));
    const auto shake = [&](int from, int to) {
        for (int frame = from; frame < to; ++frame) {
            sim.set_roots(head_at({0.05f * std::sin(0.2f * static_cast<float>(frame)), 0, 0}));
            sim.step(1.0 / 60);
        }
        return sim.hash();
    };
    shake(0, 30);
    const auto saved = sim.save();
    const std::uint64_t once = shake(30, 90);
    sim.restore(saved);
    EXPECT_EQ(shake(30, 90), once);
}
