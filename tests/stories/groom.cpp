// Hair is groomed under gravity. A sag-free groom is in balance as it was drawn; another one sinks.
#include "story.hpp"

using namespace story;

TEST(Groom, a_sag_free_one_stays_as_it_was_drawn) {
    const plait::Context context;
    for (const plait_sag_free mode : {PLAIT_SAG_FREE_STIFFEN, PLAIT_SAG_FREE_OFF}) {
        plait::SimDesc desc;
        desc.sag_free = mode;
        plait::Sim sim(context, hair(level), desc);
        pass(sim, 2);
        const float moved = distance(tip_of(sim), {length, 0, 0});
        if (mode == PLAIT_SAG_FREE_OFF) {
            EXPECT_GT(moved, 0.2f);
        } else {
            EXPECT_LT(moved, 1e-3f);
        }
    }
}

// The slider "groom against physics": 0.5 leaves half of the droop.
TEST(Groom, a_slider_shares_its_droop) {
    const plait::Context context;
    const auto droop = [&](float groom) {
        plait::SimDesc desc;
        desc.material.bend_stiffness = 5e-7f; // N m^2: a lock, which sinks by less than a tenth
        desc.params.groom = groom;
        plait::Sim sim(context, hair(level), desc);
        pass(sim, 5);
        return -tip_of(sim)[1];
    };
    EXPECT_NEAR(droop(0.5f) / droop(0), 0.5f, 0.1f);
    EXPECT_LT(droop(1), 1e-4f);
}
