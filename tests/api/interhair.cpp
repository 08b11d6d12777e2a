// The inter-hair step as the thesis has it, hash and rule, in whole steps of the model it was made
// for.
#include "support.hpp"

namespace {

plait_sim_desc thesis_desc() {
    auto desc = tressfx_desc();
    desc.params.gravity[1] = 0; // the hair stays where the grid is
    desc.params.interhair = PLAIT_INTERHAIR_SLOTS;
    desc.params.slot_hash = PLAIT_SLOT_HASH_RULE_THESIS;
    desc.params.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
    desc.params.slot_capacity = 16; // so few that vertices compete for them
    return desc;
}

// Hair that a head has swung to and fro for half a second.
plait::Sim swung(const plait::Context& context, const plait_sim_desc& desc) {
    plait::Sim sim(context, make_groom(tuft(24, 16)), desc);
    for (int i = 1; i <= 30; ++i) {
        sim.set_roots(head_at({0.05f * std::sin(0.6f * static_cast<float>(i)), 0, 0}));
        sim.step(frame);
    }
    return sim;
}

// What Verlet integration goes on with: how far each coordinate came in the last step, m.
std::vector<float> paths_of(const plait::Sim& sim) {
    std::vector<float> paths = sim.read(PLAIT_FIELD_POSITION);
    const std::vector<float> before = sim.read(PLAIT_FIELD_POSITION_PREV);
    for (size_t i = 0; i < paths.size(); ++i)
        paths[i] -= before[i];
    return paths;
}

class ThesisStep : public OnBackend {};
ON_EVERY_BACKEND(ThesisStep);

// After one step more, once without brakes and once with them.
TEST_P(ThesisStep, takes_a_tenth_of_what_is_fast_and_nothing_else) {
    plait_sim_desc desc = thesis_desc();
    desc.params.interhair = PLAIT_INTERHAIR_OFF; // who won the slots of before would show
    plait::Sim free = swung(context, desc), braked = swung(context, desc);
    ASSERT_EQ(free.hash(), braked.hash());
    desc.params.interhair = PLAIT_INTERHAIR_SLOTS;
    braked.set_params(desc.params);
    free.step(frame);
    braked.step(frame);
    EXPECT_EQ(braked.stats().grid_outside, 0u);
    const std::vector<float> own = paths_of(free), left = paths_of(braked);
    size_t fast = 0, slow = 0;
    for (size_t i = 0; i < own.size(); ++i)
        if (std::abs(own[i]) > 1e-5f) { // 1e-3 of it is what float32 makes of the position
            const float share = left[i] / own[i];
            (share < 0.95f ? fast : slow) += 1;
            EXPECT_NEAR(share, share < 0.95f ? 0.9f : 1.0f, 4e-3f) << "coordinate " << i;
        }
    EXPECT_GT(fast, 50u);
    EXPECT_GT(slow, 50u);
}

TEST_P(ThesisStep, stays_finite_when_hair_hangs_out_of_the_grid) {
    plait_sim_desc desc = thesis_desc();
    desc.params.gravity[1] = -9.81f;
    plait::Sim sim = swung(context, desc);
    run(sim, 120);
    EXPECT_EQ(sim.stats().nonfinite, 0u);
    EXPECT_GT(sim.stats().grid_outside, 0u);
}

// Which writer wins a slot is the device's business; the reference goes through them in order.
TEST(ThesisStepOnReference, repeats_and_is_neither_the_other_hash_nor_the_other_rule) {
    const plait::Context context = make_context("reference");
    plait_sim_desc desc = thesis_desc();
    const uint64_t hash = swung(context, desc).hash();
    EXPECT_EQ(swung(context, desc).hash(), hash);
    desc.params.slot_hash = PLAIT_SLOT_HASH_RULE_PCG;
    EXPECT_NE(swung(context, desc).hash(), hash);
    desc = thesis_desc();
    desc.params.diffuse_rule = PLAIT_DIFFUSE_RULE_FLOORED;
    EXPECT_NE(swung(context, desc).hash(), hash);
}

} // namespace
