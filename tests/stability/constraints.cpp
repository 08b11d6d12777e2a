// TressFX's attachment to the root; its shape constraints: tressfx.cpp.
#include "one_strand.hpp"

namespace plait::test {
namespace {

constexpr StrandShape hanging{17, 0.3f, {0.0f, -1.0f, 0.0f}};

float farthest_from_root(const OneStrand& strand) {
    const auto x = strand.read(PLAIT_FIELD_POSITION);
    float farthest = 0;
    for (const auto& p : x)
        farthest = std::max(farthest, std::hypot(p[0] - x[0][0], p[1] - x[0][1], p[2] - x[0][2]));
    return farthest;
}

TEST(Constraints, attachment_holds_through_a_jump) {
    plait::SimDesc attached;
    attached.model = PLAIT_MODEL_TRESSFX;
    attached.tressfx.attachment = 1.05f;
    OneStrand strand(hanging, attached);
    strand.run(0.5);
    strand.move_head({30.0f, 0.0f, 0.0f});
    for (int step = 0; step < 60; ++step) {
        strand.step();
        ASSERT_LT(farthest_from_root(strand), 1.05f * hanging.length * 1.0001f) << step;
    }
}

} // namespace
} // namespace plait::test
