// Heads, roots of their own, bones, and carrying hair without dynamics.
#include "support.hpp"

namespace {

class Roots : public OnBackend {};
ON_EVERY_BACKEND(Roots);

const float s = std::sqrt(0.5f);

TEST_P(Roots, TeleportCarriesTheHairRigidly) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    run(sim, 20);
    const auto before = sim.read(PLAIT_FIELD_POSITION);
    const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
    sim.teleport(head_at({2, 0, 1}, {0, 0, s, s})); // a quarter turn about z
    const auto after = sim.read(PLAIT_FIELD_POSITION);
    const auto turned = sim.read(PLAIT_FIELD_VELOCITY);
    for (size_t i = 0; i < before.size(); i += 4) {
        EXPECT_NEAR(after[i], 2 - before[i + 1], 1e-6);
        EXPECT_NEAR(after[i + 1], before[i], 1e-6);
        EXPECT_NEAR(after[i + 2], 1 + before[i + 2], 1e-6);
        EXPECT_EQ(after[i + 3], before[i + 3]);
        EXPECT_NEAR(turned[i], -velocity[i + 1], 1e-4);
        EXPECT_NEAR(turned[i + 1], velocity[i], 1e-4);
    }
    const float stretch = sim.measure().max_stretch;
    sim.step(frame);
    EXPECT_LT(sim.measure().max_stretch, stretch + 0.05f);
}

TEST_P(Roots, ResetPutsTheHairAtRestOnThePresentRoots) {
    plait::Sim sim(context, make_groom(tuft(3, 8)));
    sim.set_roots(head_at({0.1f, 0, 0}));
    run(sim, 10);
    sim.reset();
    const auto rest = sim.read(PLAIT_FIELD_REST);
    auto expected = rest;
    for (size_t i = 0; i < expected.size(); i += 4)
        expected[i] += 0.1f;
    EXPECT_LT(largest_difference(sim.read(PLAIT_FIELD_POSITION), expected), 1e-6f);
    EXPECT_LT(
        largest_difference(sim.read(PLAIT_FIELD_VELOCITY), std::vector<float>(rest.size(), 0.0f)),
        1e-4f);
    EXPECT_EQ(sim.describe().steps, 0u);
}

TEST_P(Roots, RootsOfTheirOwnAreAppliedBeforeTheHead) {
    plait::Sim sim(context, make_groom(tuft(2, 5)));
    const std::vector<plait_pose> own = {{{0, 0, 0, 1}, {0.05f, 0, 0}}, {{0, 0, s, s}, {0, 0, 0}}};
    auto roots = head_at({0, 0, 1}, {0, 0, s, s});
    roots.root_poses = plait::view(own);
    sim.set_roots(roots);
    sim.step(frame);
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    EXPECT_NEAR(p[0], 0, 1e-6); // (0,0,0) -> (0.05,0,0) -> (0,0.05,1)
    EXPECT_NEAR(p[1], 0.05, 1e-6);
    EXPECT_NEAR(p[2], 1, 1e-6);
    const float* second = &p[5 * 4]; // (0,0.01,0) -> (-0.01,0,0) -> (0,-0.01,1)
    EXPECT_NEAR(second[0], 0, 1e-6);
    EXPECT_NEAR(second[1], -0.01, 1e-6);
    EXPECT_NEAR(second[2], 1, 1e-6);
    sim.set_roots(head_at({0, 0, 0})); // and back to none
    sim.step(frame);
    EXPECT_NEAR(sim.read(PLAIT_FIELD_POSITION)[5 * 4 + 1], 0.01, 1e-6);
}

TEST_P(Roots, BonesBlendToTheClosestRotation) {
    const GroomArrays arrays(tuft(2, 4));
    const std::vector<uint32_t> indices = {0, 1, 0, 0, 1, 0, 0, 0};
    const std::vector<float> weights = {0.5f, 0.5f, 0, 0, 1, 0, 0, 0};
    auto desc = arrays.desc();
    desc.bone_indices = plait::view(indices, 4);
    desc.bone_weights = plait::view(weights, 4);
    const plait::Groom groom(desc);
    EXPECT_EQ(groom.describe().bones, 2u);
    plait::Sim sim(context, groom, tressfx_desc());
    const std::vector<float> bones = {1, 0,  0, 0, 0, 1, 0, 0, 0, 0, 1, 0,  // identity
                                      0, -1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0}; // quarter turn, +x
    auto roots = plait_roots_defaults();
    roots.bones = plait::view(bones, 12);
    sim.set_roots(roots);
    sim.step(frame);
    const auto p = sim.read(PLAIT_FIELD_POSITION);
    const auto rest = sim.read(PLAIT_FIELD_REST);
    // Half of each: the root at the mean of both images, the first segment turned by 45 degrees.
    EXPECT_NEAR(p[0], 0.5, 1e-6);
    EXPECT_NEAR(p[1], 0, 1e-6);
    const float dx = rest[4] - rest[0], dy = rest[5] - rest[1];
    EXPECT_NEAR(p[4] - p[0], s * (dx - dy), 1e-6);
    EXPECT_NEAR(p[5] - p[1], s * (dx + dy), 1e-6);
    EXPECT_NEAR(p[16], 1 - 0.01, 1e-6); // wholly the second bone
    EXPECT_NEAR(p[17], 0, 1e-6);
}

TEST_P(Roots, ABoneThatMapsAllToALineIsRefused) {
    const GroomArrays arrays(tuft(2, 5));
    const std::vector<uint32_t> indices = {0, 1, 0, 0, 1, 0, 0, 0};
    const std::vector<float> weights = {0.5f, 0.5f, 0, 0, 1, 0, 0, 0};
    auto desc = arrays.desc();
    desc.bone_indices = plait::view(indices, 4);
    desc.bone_weights = plait::view(weights, 4);
    plait::Sim sim(context, plait::Groom(desc), tressfx_desc());
    const std::vector<float> bones = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0,
                                      1, 2, 3, 1, 2, 4, 6, 0, 0, 0, 0, 0};
    auto roots = plait_roots_defaults();
    roots.bones = plait::view(bones, 12);
    EXPECT_EQ(plait_sim_set_roots(sim, &roots), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("bones[1] has no closest rotation"),
              std::string::npos)
        << plait_last_error();
    sim.step(frame);
    EXPECT_EQ(sim.read(PLAIT_FIELD_POSITION)[0], 0) << "what is refused changes nothing";
}

TEST_P(Roots, SeveralStepsInOneCallSpreadTheMotion) {
    for (const plait_model model : {PLAIT_MODEL_TRESSFX, PLAIT_MODEL_ARTICULATED}) {
        plait::SimDesc desc;
        desc.model = model;
        desc.substeps = 2;
        desc.params.gravity[1] = 0;
        plait::Sim sim(context, make_groom(tuft(2, 3)), desc);
        sim.set_roots(head_at({0, 0, 0})); // where it is
        sim.set_roots(head_at({0.4f, 0, 0}));
        sim.step(4 * frame);
        EXPECT_EQ(sim.describe().steps, 4u);
        const auto velocity = sim.read(PLAIT_FIELD_VELOCITY);
        EXPECT_NEAR(velocity[0], 0.1 / frame, 1e-3) << model; // of the root in the last part
        EXPECT_NEAR(velocity[3 * 4], 0.1 / frame, 1e-3) << model;
        sim.step(frame);
        sim.step(frame); // and at rest, once its path has bent
        EXPECT_NEAR(sim.read(PLAIT_FIELD_VELOCITY)[0], 0, 1e-5) << model;
    }
}

} // namespace
