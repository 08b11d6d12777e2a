// The caller pushes vertices: 5 m/s^2 to the side lean hanging hair by atan(5/9.81).
#include "story.hpp"

using namespace story;

TEST(Push, leans_hair) {
    const plait::Context context;
    plait::SimDesc desc;
    desc.acceleration.on = true;
    desc.material.bend_stiffness = 0;
    plait::Sim sim(context, hair(down), desc);
    std::vector<float> push(4 * vertices, 0.0f); // m/s^2, float4 each
    for (std::uint32_t i = 0; i < vertices; ++i)
        push[4 * i] = 5;
    sim.write(PLAIT_FIELD_ACCELERATION, push);
    pass(sim, 10);
    const Point end = tip_of(sim);
    EXPECT_NEAR(std::atan2(end[0], -end[1]), std::atan2(5.0f, 9.81f), 0.02f);
}
