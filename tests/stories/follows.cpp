// Few hairs are simulated, and many follow: each at its own length, near where it would have been.
#include "story.hpp"

using namespace story;

TEST(Follows, move_with_their_guides_and_keep_their_length) {
    const plait::Context context;
    std::vector<Point> roots;
    for (int i = 0; i < 400; ++i)
        roots.push_back({0.005f * float(i % 20), 0, 0.005f * float(i / 20)});
    const plait::Groom all = hairs(roots, level);
    const auto [guides, map] = all.guides(20);
    plait::SimDesc desc;
    desc.follow_map = map;
    plait::Sim sim(context, guides, desc);
    const auto info = sim.describe();
    EXPECT_EQ(info.guides, 20u);
    EXPECT_GE(info.strands, 400u);
    pass(sim, 1);
    for (std::uint32_t strand = 0; strand < info.strands; ++strand) {
        float along = 0;
        for (std::uint32_t i = 1; i < vertices; ++i)
            along += distance(vertex(sim, strand, i), vertex(sim, strand, i - 1));
        EXPECT_NEAR(along, length, 1e-4f) << "strand " << strand;
        EXPECT_LT(tip_of(sim, strand)[1], -0.1f) << "strand " << strand << " has fallen";
    }
}
