// In a train that brakes, hair hangs as in one that stands, if the frame is not felt.
#include "story.hpp"

using namespace story;

TEST(Frame, of_a_train_that_brakes_is_felt_by_a_share) {
    const plait::Context context;
    for (const float share : {0.0f, 1.0f}) {
        plait::Sim sim(context, hair(down));
        auto train = plait_frame_desc_defaults();
        train.felt_translation = share;
        sim.set_frame(train);
        sim.set_roots(head_at({0, 0, 0}));
        float swung = 0;
        for (int i = 1; i <= 60; ++i) { // from 30 m/s with 10 m/s^2
            const float t = static_cast<float>(i) / 60, way = 30 * t - 5 * t * t;
            train.pose.t[0] = way;
            sim.set_frame(train);
            sim.set_roots(head_at({way, 0, 0}));
            sim.step(1.0 / 60);
            if (i > 30) // the start is felt, too
                swung = std::max(swung, std::abs(tip_of(sim)[0] - way));
        }
        if (share == 0) {
            EXPECT_LT(swung, 1e-4f);
        } else {
            EXPECT_GT(swung, 0.05f);
        }
    }
}
