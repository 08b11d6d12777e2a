// Wet hair is heavier and softer: a level lock sags about three times as far, and dries.
#include "story.hpp"

using namespace story;

TEST(Wetness, makes_hair_sag) {
    const plait::Context context;
    const auto sag = [&](float wet, float drying_time) {
        plait::SimDesc desc;
        desc.material.bend_stiffness = 2e-6f; // N m^2
        desc.wetness.on = true;
        desc.wetness.drying_time = drying_time;
        plait::Sim sim(context, hair(level), desc);
        sim.write(PLAIT_FIELD_WETNESS, {wet});
        pass(sim, 5);
        return -tip_of(sim)[1];
    };
    const float dry = sag(0, 0);
    EXPECT_NEAR(sag(1, 0) / dry, 3.2f, 0.2f);
    EXPECT_NEAR(sag(1, 0.5f) / dry, 1, 0.01f) << "it has dried";
}
