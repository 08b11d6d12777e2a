// TressFX's strands are there to compare with. Their stiffness is a share per step: at other steps the hair
// is another one. The default model's is a modulus.
#include "story.hpp"

using namespace story;

TEST(Tressfx, is_another_hair_at_another_step) {
    const plait::Context context;
    const auto moved = [&](plait_model model) {
        std::vector<Point> tips;
        for (const float rate : {60.0f, 240.0f}) {
            plait::SimDesc desc;
            desc.model = model;
            desc.step = 1 / rate;
            plait::Sim sim(context, hair({0.6f, -0.8f, 0}), desc);
            pass(sim, 0.25);
            tips.push_back(tip_of(sim));
        }
        return distance(tips[0], tips[1]);
    };
    EXPECT_GT(moved(PLAIT_MODEL_TRESSFX), 2 * moved(PLAIT_MODEL_ARTICULATED));
}
