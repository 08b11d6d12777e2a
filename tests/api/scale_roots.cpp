// Roots that have the scale: on meshes and by bones.
#include "mesh_shapes.hpp"
#include "scale_scenes.hpp"

#include <limits>

namespace {

using namespace scaled;

class ScaleOfRoots : public OnBackend {};
ON_EVERY_BACKEND(ScaleOfRoots);

plait::Mesh make_mesh(const ShapeMesh& shape) {
    auto desc = plait_mesh_desc_defaults();
    desc.positions = {shape.positions.data(), shape.positions.size(), 0};
    desc.triangles = {shape.triangles.data(), shape.triangles.size(), 0};
    return plait::Mesh(desc);
}

TEST_P(ScaleOfRoots, RootsOnAMeshHaveTheirPlaceOnIt) {
    const auto mesh = make_mesh(box_mesh(0.05, 0.1, 0.1));
    auto posed = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    for (float& x : posed)
        x *= 3;
    Scene scene(context, PLAIT_MODEL_ARTICULATED, 3);
    scene.sim.bind_roots(mesh);
    auto roots = roots_at(3);
    roots.mesh_positions = plait::view(posed, 3);
    scene.sim.teleport(roots);
    const auto hair = scene.hair(), rest = scene.sim.read(PLAIT_FIELD_REST);
    for (size_t i = 0; i < rest.size(); ++i)
        EXPECT_NEAR(hair[i], rest[i], 1e-5f);
}

TEST_P(ScaleOfRoots, AMirroredMeshIsRefused) {
    const auto mesh = make_mesh(ellipsoid_mesh(0.08, 0.1, 0.09, 24, 16));
    Strands around;
    for (const Point n : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{-0.6f, 0.8f, 0}})
        around.push_back(
            {{0.08f * n[0], 0.1f * n[1], 0.09f * n[2]}, {0.1f * n[0], 0.12f * n[1], 0.11f * n[2]}});
    plait::Sim sim(context, make_groom(around));
    sim.bind_roots(mesh);
    auto posed = mesh.read<float>(PLAIT_MESH_FIELD_POSITIONS);
    auto roots = plait_roots_defaults();
    for (const float mirror : {1.0f, -1.0f}) {
        for (size_t i = 0; i < posed.size(); i += 3)
            posed[i] *= mirror;
        roots.mesh_positions = plait::view(posed, 3);
        EXPECT_EQ(plait_sim_set_roots(sim.get(), &roots),
                  mirror > 0 ? PLAIT_OK : PLAIT_INVALID_ARGUMENT);
    }
    EXPECT_NE(std::string(plait_last_error()).find("mesh_positions mirror the mesh"),
              std::string::npos)
        << plait_last_error();
}

struct Skinned {
    explicit Skinned(const plait::Context& context) : sim(make(context)) {}
    static plait::Sim make(const plait::Context& context) {
        const GroomArrays arrays(tuft(2, 5));
        const std::vector<uint32_t> indices = {0, 1, 2, 0, 1, 0, 2, 0};
        const std::vector<float> weights = {1, 0, 0, 0, 0.5f, 0.25f, 0.25f, 0};
        auto desc = arrays.desc();
        desc.bone_indices = plait::view(indices, 4);
        desc.bone_weights = plait::view(weights, 4);
        return plait::Sim(context, plait::Groom(desc));
    }
    plait_result set(const std::array<float, 3>& of_bone, float scale = 1) {
        bones.assign(36, 0.0f);
        for (size_t bone = 0; bone < 3; ++bone)
            for (size_t k = 0; k < 3; ++k)
                bones[12 * bone + 5 * k] = bone == 1 ? of_bone[k] : all;
        for (size_t bone = 0; bone < 3; ++bone)
            for (size_t k = 0; k < 3; ++k)
                bones[12 * bone + 4 * k + 3] = at[k];
        roots = plait_roots_defaults();
        roots.bones = plait::view(bones, 12);
        roots.scale = scale;
        return plait_sim_set_roots(sim.get(), &roots);
    }
    float all = 1; // of the other bones
    Point at = {0, 0, 0};
    std::vector<float> bones;
    plait_roots roots{};
    plait::Sim sim;
};

TEST_P(ScaleOfRoots, BonesThatScaleAlikeScaleHair) {
    Skinned skinned(context);
    skinned.all = 8;
    ASSERT_EQ(skinned.set({8, 8, 8}), PLAIT_OK) << plait_last_error();
    EXPECT_EQ(skinned.sim.describe().scale, 8);
    auto rest = skinned.sim.read(PLAIT_FIELD_REST);
    for (size_t i = 0; i < rest.size(); ++i)
        rest[i] *= i % 4 < 3 ? 8.0f : 0.0f;
    auto hair = skinned.sim.read(PLAIT_FIELD_POSITION);
    for (size_t i = 3; i < hair.size(); i += 4)
        hair[i] = 0;
    EXPECT_LT(largest_difference(hair, rest), 1e-5f);
    ASSERT_EQ(skinned.set({8, 8, 8}, 0.5f), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 4);
    skinned.all = 1.0f + 1e-6f; // a rotation that is rounded
    ASSERT_EQ(skinned.set({1, 1, 1}), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 1);
}

// Far from the origin, by skinning matrices of the world.
TEST_P(ScaleOfRoots, ASkinThatGrowsInTheWorldThrowsNoHair) {
    Skinned scene(context), stays(context);
    scene.at = stays.at = {5, 1, -3};
    scene.set({1, 1, 1});
    stays.set({1, 1, 1});
    run(scene.sim, 60);
    run(stays.sim, 60);
    for (int step = 1; step <= 30; ++step) {
        scene.all = 1 + 0.1f * static_cast<float>(std::min(step, 20));
        if (step > 20) {
            scene.at[0] += 0.02f * scene.all;
            stays.at[0] += 0.02f;
        }
        scene.set({scene.all, scene.all, scene.all});
        stays.set({1, 1, 1});
        scene.sim.step(frame);
        stays.sim.step(frame);
        auto hair = scene.sim.read(PLAIT_FIELD_POSITION),
             other = stays.sim.read(PLAIT_FIELD_POSITION);
        for (size_t i = 0; i < hair.size(); ++i)
            if (i % 4 < 3) {
                hair[i] = (hair[i] - scene.at[i % 4]) / scene.all;
                other[i] -= stays.at[i % 4];
            }
        ASSERT_LT(largest_difference(hair, other), 2e-5f) << step;
    }
}

TEST_P(ScaleOfRoots, AMirroredSkinIsRefusedAndAnUnevenOneWarnedOf) {
    std::vector<std::string> said;
    auto desc = plait_context_desc_defaults();
    const std::string backend = GetParam();
    desc.backend = backend.c_str();
    desc.log_user = &said;
    desc.log = [](plait_log_level level, const char* text, void* user) {
        if (level >= PLAIT_LOG_LEVEL_WARNING)
            static_cast<std::vector<std::string>*>(user)->emplace_back(text);
    };
    const plait::Context own(desc);
    Skinned skinned(own);
    said.clear();
    EXPECT_EQ(skinned.set({-1, 1, 1}), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("bones[1] mirrors"), std::string::npos);
    ASSERT_EQ(skinned.set({1, 1.5f, 1}), PLAIT_OK);
    EXPECT_EQ(skinned.sim.describe().scale, 1) << "most bones are not scaled";
    ASSERT_EQ(skinned.set({1, 1.5f, 1}), PLAIT_OK);
    ASSERT_EQ(said.size(), 1u) << "said once";
    EXPECT_NE(said[0].find("bones[1] scales by 1.5, 1 and 1 along its axes, bones together by 1"),
              std::string::npos)
        << said[0];
}

TEST_P(ScaleOfRoots, ThatOfBonesAndTheCallersTogetherHasARange) {
    Skinned skinned(context);
    skinned.all = 8;
    EXPECT_EQ(skinned.set({8, 8, 8}, 500), PLAIT_INVALID_ARGUMENT);
    EXPECT_NE(std::string(plait_last_error()).find("times that of roots->bones is 4000"),
              std::string::npos)
        << plait_last_error();
}

} // namespace
