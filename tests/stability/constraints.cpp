// What artists may add to the physics of a strand: attachment to the root, global and local shape.
#include "one_strand.hpp"

#include <set>
#include <string>

namespace plait::test {
namespace {

constexpr StrandShape level{17, 0.3f, {1.0f, 0.0f, 0.0f}};
constexpr StrandShape hanging{17, 0.3f, {0.0f, -1.0f, 0.0f}};

constexpr const char* names[] = {"tressfx", "chain", "cosserat", "rod", "articulated"};

class Constraints : public testing::TestWithParam<plait_model> {
  protected:
    plait_sim_desc desc() const {
        plait_sim_desc desc = plait_sim_desc_defaults();
        desc.model = GetParam();
        return desc;
    }
};

INSTANTIATE_TEST_SUITE_P(Models, Constraints,
                         testing::Values(PLAIT_MODEL_TRESSFX, PLAIT_MODEL_CHAIN,
                                         PLAIT_MODEL_COSSERAT, PLAIT_MODEL_ROD,
                                         PLAIT_MODEL_ARTICULATED),
                         [](const auto& model) { return std::string(names[model.param]); });

// TressFX always has shape constraints; see tressfx.cpp.
class ShapeOptions : public Constraints {};

INSTANTIATE_TEST_SUITE_P(Models, ShapeOptions,
                         testing::Values(PLAIT_MODEL_CHAIN, PLAIT_MODEL_COSSERAT, PLAIT_MODEL_ROD,
                                         PLAIT_MODEL_ARTICULATED),
                         [](const auto& model) { return std::string(names[model.param]); });

float farthest_from_root(const OneStrand& strand) {
    const auto x = strand.read(PLAIT_FIELD_POSITION);
    float farthest = 0;
    for (const auto& p : x)
        farthest = std::max(farthest, std::hypot(p[0] - x[0][0], p[1] - x[0][1], p[2] - x[0][2]));
    return farthest;
}

TEST_P(Constraints, attachment_holds_through_a_jump) {
    plait_sim_desc attached = desc();
    attached.params.attachment = 1.05f;
    OneStrand strand(hanging, attached);
    strand.run(0.5);
    strand.move_head({30.0f, 0.0f, 0.0f});
    for (int step = 0; step < 60; ++step) {
        strand.step();
        ASSERT_LT(farthest_from_root(strand), 1.05f * hanging.length * 1.0001f) << step;
    }
}

// How high the tip of a strand that was level stands after 5 s.
float tip_height(const plait_sim_desc& desc) {
    OneStrand strand(level, desc);
    strand.run(5.0);
    return strand.tip()[1];
}

TEST_P(ShapeOptions, global_shape_draws_towards_rest) {
    plait_sim_desc shaped = desc();
    shaped.params.shape_constraints = 1;
    shaped.params.local_stiffness = 0;
    shaped.params.global_stiffness = 0.3f;
    shaped.params.global_range = 1.0f;
    EXPECT_GT(tip_height(shaped), tip_height(desc()) + 0.1f);
}

// Half a circle, in its plane.
std::vector<Vec3> arch() {
    std::vector<Vec3> points;
    for (int i = 0; i <= 16; ++i) {
        const float angle = 3.14159265f * static_cast<float>(i) / 16;
        points.push_back({0.1f * std::sin(angle), 0.1f * (std::cos(angle) - 1), 0.0f});
    }
    return points;
}

// From root to tip after 5 s; 0.2 m at rest, 0.31 m when drawn straight.
float chord(const plait_sim_desc& desc) {
    OneStrand strand(arch(), desc);
    strand.run(5.0);
    const auto x = strand.read(PLAIT_FIELD_POSITION);
    return std::hypot(x.back()[0] - x[0][0], x.back()[1] - x[0][1], x.back()[2] - x[0][2]);
}

// Relative to the segment before: it keeps a strand bent, whichever way the root segment points.
TEST_P(ShapeOptions, local_shape_keeps_a_bend) {
    plait_sim_desc shaped = desc();
    shaped.params.shape_constraints = 1;
    shaped.params.local_stiffness = 0.9f;
    shaped.params.local_iterations = 8;
    const float free = chord(desc());
    EXPECT_GT(free, 0.26f);
    EXPECT_LT(chord(shaped), free - 0.02f);
}

TEST_P(ShapeOptions, off_means_off) {
    plait_sim_desc changed = desc();
    changed.params.global_stiffness = 0.3f;
    changed.params.global_range = 1.0f;
    changed.params.local_stiffness = 0.1f;
    EXPECT_EQ(tip_height(desc()), tip_height(changed));
}

// Of one step.
std::set<std::string> stages_of(const plait_sim_desc& desc) {
    OneStrand strand(level, desc);
    strand.step();
    size_t count = 0;
    PLAIT_EXPECT(plait_sim_get_stage_times(strand.sim(), nullptr, &count, 1)); // forgets the start
    strand.step();
    PLAIT_EXPECT(plait_sim_get_stage_times(strand.sim(), nullptr, &count, 0));
    std::vector<plait_stage_time> times(count);
    PLAIT_EXPECT(plait_sim_get_stage_times(strand.sim(), times.data(), &count, 0));
    std::set<std::string> stages;
    for (const plait_stage_time& time : times)
        if (time.calls > 0)
            stages.insert(time.stage);
    return stages;
}

TEST_P(ShapeOptions, off_costs_nothing) {
    plait_sim_desc shaped = desc();
    shaped.params.shape_constraints = 1;
    shaped.params.global_stiffness = 0.3f;
    shaped.params.global_range = 1.0f;
    shaped.params.attachment = 1.05f;
    const std::set<std::string> off = stages_of(desc()), on = stages_of(shaped);
    for (const char* option : {"global_shape", "local_shape", "attach", "lane_pack"}) {
        EXPECT_FALSE(off.contains(option)) << option;
        EXPECT_TRUE(on.contains(option)) << option;
    }
    EXPECT_TRUE(off.contains(names[GetParam()]));
}

} // namespace
} // namespace plait::test
