// The grid between strands slows a hair that moves much faster than those around it.
#include "story.hpp"

using namespace story;

TEST(Grid, slows_a_wild_hair_among_calm_ones) {
    const plait::Context context;
    const auto swing = [&](bool grid) {
        std::vector<Point> roots;
        for (int i = 0; i < 64; ++i)
            roots.push_back({0.005f * float(i % 8), 0, 0.005f * float(i / 8)});
        plait::SimDesc desc;
        desc.grid.on = grid;
        plait::Sim sim(context, hairs(roots, down), desc);
        auto v = sim.read(PLAIT_FIELD_VELOCITY); // m/s, float4 each
        for (std::uint32_t i = 1; i < vertices; ++i)
            v[4 * (27 * vertices + i)] = 0.5f * float(i) / float(tip);
        sim.write(PLAIT_FIELD_VELOCITY, v);
        float farthest = 0;
        for (int frame = 0; frame < 30; ++frame) {
            sim.step(1.0 / 60);
            farthest = std::max(farthest, tip_of(sim, 27)[0] - 0.015f);
        }
        return farthest;
    };
    const float free = swing(false), braked = swing(true);
    EXPECT_GT(free, 0.03f);
    EXPECT_LT(braked, 0.7f * free);
}
