// Drag: relative to the wind, and to air that goes with the head.
#include "stability/one_strand.hpp"

#include <numbers>

namespace plait::test {
namespace {

// Degrees from upright, backwards, of a strand that a head has carried along x at 2 m/s for 20 s.
double tilt_on_a_moving_head(const plait::SimDesc& desc) {
    constexpr float speed = 2.0f; // m/s
    OneStrand strand(StrandShape{17, 0.3f, {0.0f, -1.0f, 0.0f}}, desc);
    for (int i = 1; i <= 1200; ++i) {
        strand.move_head({speed * static_cast<float>(i) / 60.0f, 0.0f, 0.0f});
        strand.step();
    }
    const auto x = strand.read(PLAIT_FIELD_POSITION);
    const double across = double(x.front()[0]) - double(x.back()[0]);
    return std::atan2(across, double(x.front()[1]) - double(x.back()[1])) * 180.0 /
           std::numbers::pi;
}

class Air : public testing::TestWithParam<plait_model> {};

INSTANTIATE_TEST_SUITE_P(Models, Air, testing::Values(PLAIT_MODEL_ARTICULATED));

TEST_P(Air, with_the_head_leaves_hair_hanging) {
    plait::SimDesc desc;
    desc.model = GetParam();
    desc.params.air_with_head = 1.0f;
    EXPECT_NEAR(tilt_on_a_moving_head(desc), 0.0, 0.5);
}

// A limp strand hangs along the sum of weight and drag: c v/g.
TEST(Air, drags_hair_by_the_head_s_own_speed) {
    plait::SimDesc desc;
    desc.material.bend_stiffness = 0.0f;
    desc.params.drag = 2.0f; // 1/s
    for (const float share : {0.0f, 0.25f}) {
        desc.params.air_with_head = share;
        const double expected = std::atan((1.0 - double(share)) * 2.0 * 2.0 / 9.81);
        EXPECT_NEAR(tilt_on_a_moving_head(desc), expected * 180.0 / std::numbers::pi, 0.1);
    }
}

} // namespace
} // namespace plait::test
