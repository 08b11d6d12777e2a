// The inter-hair step as the thesis has it, hash and rule, in whole steps of the model it was made
// for.
#include "support.hpp"

namespace {

plait::SimDesc thesis_desc() {
    auto desc = tressfx_desc();
    desc.params.gravity[1] = 0; // the hair stays where the grid is
    desc.grid.on = true;
    desc.grid.form = PLAIT_GRID_FORM_SLOTS;
    desc.grid.slot_hash = PLAIT_SLOT_HASH_RULE_THESIS;
    desc.grid.diffuse_rule = PLAIT_DIFFUSE_RULE_THESIS;
    desc.grid.slot_capacity = 16; // so few that vertices compete for them
    return desc;
}

// Hair that a head has swung to and fro for half a second.
plait::Sim swung(const plait::Context& context, const plait::SimDesc& desc) {
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
    plait::SimDesc desc = thesis_desc();
    desc.grid.on = false; // who won the slots of before would show
    plait::Sim free = swung(context, desc), braked = swung(context, desc);
    ASSERT_EQ(free.hash(), braked.hash());
    desc.grid.on = true;
    desc.grid.form = PLAIT_GRID_FORM_SLOTS;
    braked.set_all(desc);
    free.step(frame);
    braked.step(frame);
    EXPECT_EQ(braked.measure().grid_outside, 0u);
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
    plait::SimDesc desc = thesis_desc();
    desc.params.gravity[1] = -9.81f;
    plait::Sim sim = swung(context, desc);
    run(sim, 120);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
    EXPECT_GT(sim.measure().grid_outside, 0u);
}

// Which writer wins a slot is the device's business; the reference goes through them in order.
TEST(ThesisStepOnReference, repeats_and_is_neither_the_other_hash_nor_the_other_rule) {
    const plait::Context context = make_context("reference");
    plait::SimDesc desc = thesis_desc();
    const uint64_t hash = swung(context, desc).hash();
    EXPECT_EQ(swung(context, desc).hash(), hash);
    desc.grid.slot_hash = PLAIT_SLOT_HASH_RULE_PCG;
    EXPECT_NE(swung(context, desc).hash(), hash);
    desc = thesis_desc();
    desc.grid.diffuse_rule = PLAIT_DIFFUSE_RULE_FLOORED;
    EXPECT_NE(swung(context, desc).hash(), hash);
}

// Strands over lanes: exact sums, over positions or, on a CPU, on the lanes' own velocities.
plait::SimDesc exact_desc(plait_model model) {
    plait::SimDesc desc;
    desc.model = model;
    desc.grid.on = true;
    desc.grid.diffuse_factor = 0.5f; // so that brakes show
    return desc;
}

class ExactStep : public OnBackend {};
ON_EVERY_BACKEND(ExactStep);

// A brake takes half of a component or nothing, whatever way the velocities came to the grid.
TEST_P(ExactStep, takes_half_of_what_is_fast_and_nothing_else) {
    for (const plait_tent_form tent : {PLAIT_TENT_FORM_VOXEL, PLAIT_TENT_FORM_TRILINEAR}) {
        SCOPED_TRACE(testing::Message() << ", tent " << tent);
        plait::SimDesc desc = exact_desc(PLAIT_MODEL_ARTICULATED);
        desc.grid.tent = tent;
        desc.grid.on = false;
        plait::Sim free = swung(context, desc), braked = swung(context, desc);
        desc.grid.on = true;
        braked.set_all(desc);
        free.step(frame);
        braked.step(frame);
        EXPECT_LT(
            largest_difference(free.read(PLAIT_FIELD_POSITION), braked.read(PLAIT_FIELD_POSITION)),
            1e-6f);
        const std::vector<float> own = paths_of(free), left = paths_of(braked);
        size_t fast = 0, slow = 0;
        for (size_t i = 0; i < own.size(); ++i)
            if (std::abs(own[i]) > 1e-4f) {
                const float share = left[i] / own[i];
                (share < 0.75f ? fast : slow) += 1;
                EXPECT_NEAR(share, share < 0.75f ? 0.5f : 1.0f, 4e-3f) << "coordinate " << i;
            }
        EXPECT_GT(fast, 20u);
        EXPECT_GT(slow, 20u);
    }
}

// Strands of several parts brake each other: every vertex is in the one grid, once.
TEST_P(ExactStep, counts_strands_of_all_parts_once) {
    plait::SimDesc desc = exact_desc(PLAIT_MODEL_ARTICULATED);
    desc.grid.tent = PLAIT_TENT_FORM_TRILINEAR; // the weights of a vertex sum to 1
    plait::Sim sim = swung(context, desc);
    std::vector<uint32_t> substeps;
    for (uint32_t i = 0; i < 24; ++i)
        substeps.push_back(1 + i % 3);
    take_substeps(sim, substeps);
    run(sim, 3);
    double vertices = static_cast<double>(sim.measure().grid_outside);
    for (const float density : sim.read(PLAIT_FIELD_GRID_DENSITY))
        vertices += static_cast<double>(density);
    EXPECT_NEAR(vertices, 24 * 16, 1e-3);
    EXPECT_EQ(sim.measure().nonfinite, 0u);
}

// The caller's own kernel for a stage of the step is the one that runs, whatever the model.
TEST(ExactStepOnOpenCL, CallsTheCallersOwnBrake) {
    const plait_stage_source nothing = {
        "grid_diffuse",
        "#include <plait/params.h>\n"
        "__kernel void plait_grid_diffuse(const uint item_count, const plait_grid_params params,\n"
        "    __global const uint* vertex_count, __global const float4* position,\n"
        "    __global const float* grid_density, __global const float4* grid_velocity,\n"
        "    __global float4* position_prev) {}\n",
        "nothing.cl"};
    auto context_desc = plait_context_desc_defaults();
    context_desc.backend = "opencl";
    context_desc.stage_sources = &nothing;
    context_desc.stage_source_count = 1;
    const plait::Context own(context_desc), usual = make_context("opencl");
    plait::SimDesc desc = exact_desc(PLAIT_MODEL_ARTICULATED);
    const auto not_braked = swung(own, desc).read(PLAIT_FIELD_POSITION);
    const auto braked = swung(usual, desc).read(PLAIT_FIELD_POSITION);
    desc.grid.on = false;
    const auto free = swung(usual, desc).read(PLAIT_FIELD_POSITION);
    EXPECT_LT(largest_difference(not_braked, free), 1e-4f);
    EXPECT_GT(largest_difference(braked, free), 1e-3f);
}

} // namespace
