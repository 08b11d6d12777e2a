// A pin holds a vertex at a place: under ten times its weight it is off by at most l/100.
#include "story.hpp"

using namespace story;

TEST(Pins, hold_ten_g) {
    const plait::Context context;
    plait::SimDesc desc;
    desc.params.gravity[1] = -98.1f;
    plait::Sim sim(context, hair(level), desc);
    plait_pin pin{};
    pin.vertex = tip;
    pin.frame = PLAIT_PIN_FRAME_WORLD;
    pin.target[0] = 0.2f; // between them the hair hangs in a bow
    pin.stiffness = PLAIT_PIN_HELD;
    sim.set_pins({pin});
    pass(sim, 3);
    EXPECT_LT(distance(tip_of(sim), {0.2f, 0, 0}), length / float(tip) / 100);
    EXPECT_LT(vertex(sim, 0, tip / 2)[1], -0.05f);
}
