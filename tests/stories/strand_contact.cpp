// Guide strands meet each other: one that falls across another lies on it.
#include "story.hpp"

using namespace story;

TEST(StrandContact, a_hair_lies_across_another) {
    const plait::Context context;
    for (const bool meet : {true, false}) {
        plait::SimDesc desc;
        desc.strand_contact.on = meet;
        std::vector<float> positions; // one along z, which pins hold, and one along x above it
        for (std::uint32_t i = 0; i < vertices; ++i)
            positions.insert(positions.end(), {0.1f, 0, 0.02f * float(i) - 0.15f});
        for (std::uint32_t i = 0; i < vertices; ++i)
            positions.insert(positions.end(), {0.01f * float(i), 0.01f, 0.003f});
        auto groom = plait_groom_desc_defaults();
        groom.positions = plait::view(positions, 3);
        groom.vertices_per_strand = vertices;
        plait::Sim sim(context, plait::Groom(groom), desc);
        std::vector<plait_pin> pins;
        for (std::uint32_t i = 1; i < vertices; ++i) {
            plait_pin pin{};
            pin.vertex = i;
            pin.frame = PLAIT_PIN_FRAME_REST;
            pin.stiffness = PLAIT_PIN_HELD;
            pins.push_back(pin);
        }
        sim.set_pins(pins);
        pass(sim, 2);
        const float over = vertex(sim, 1, 10)[1];
        if (meet) {
            EXPECT_GT(over, 0.002f) << "no nearer than a radius and a half";
        } else {
            EXPECT_LT(over, -0.03f) << "it falls through";
        }
    }
}
