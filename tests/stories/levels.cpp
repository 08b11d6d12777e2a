// Hair that gets farther away is simulated by fewer strands, and later by all again: nothing jumps.
#include "story.hpp"

using namespace story;

TEST(Levels, change_while_the_head_shakes_and_nothing_jumps) {
    const plait::Context context;
    std::vector<Point> roots;
    for (int i = 0; i < 400; ++i)
        roots.push_back({0.005f * float(i % 20), 0, 0.005f * float(i / 20)});
    const plait::Groom groom = hairs(roots, down);
    auto ladder = plait_levels_desc_defaults();
    ladder.groom = groom; // 400, 50 and 12 guides, 8, and none
    const plait::Levels levels(ladder);
    plait::SimDesc desc;
    desc.levels = levels;
    plait::Sim sim(context, groom, desc);
    std::vector<float> before;
    float steady = 0, farthest = 0;
    for (int frame = 0; frame < 240; ++frame) {
        auto choice = plait_level_choice_defaults();
        choice.level = frame < 80 ? 0 : frame < 140 ? 2 : 0; // far away, and back
        sim.set_level(choice);
        sim.set_roots(head_at({0.05f * std::sin(0.1f * float(frame)), 0, 0}));
        sim.step(1.0 / 60);
        const auto now = sim.read(PLAIT_FIELD_POSITION);
        float& most = frame < 80 ? steady : farthest;
        for (std::size_t i = 0; frame > 20 && i < now.size(); ++i)
            most = std::max(most, std::abs(now[i] - before[i]));
        before = now;
    }
    EXPECT_EQ(sim.level().level, 0u);
    EXPECT_GT(steady, 2e-3f) << "m a frame: it swings";
    EXPECT_LT(farthest, 1.3f * steady) << "and no strand ever moves faster";
}
