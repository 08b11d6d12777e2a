// Bones of assimp's scenes: which are kept, which are one, and where they put a mesh.
#ifndef PLAIT_WITHOUT_ASSIMP
#include "io/mesh_bones.hpp"

#include <gtest/gtest.h>

namespace plait {
namespace {

// A mesh of three vertices, and bones that are nodes below the root.
struct Scene {
    aiScene scene;
    aiMesh* mesh = new aiMesh;

    explicit Scene(const std::vector<const char*>& bones) {
        scene.mRootNode = new aiNode("root");
        scene.mNumMeshes = 1;
        scene.mMeshes = new aiMesh* [1] { mesh };
        mesh->mName = "face";
        mesh->mNumVertices = 3;
        mesh->mVertices = new aiVector3D[3];
        mesh->mNumBones = static_cast<unsigned>(bones.size());
        mesh->mBones = new aiBone*[bones.size()];
        for (size_t b = 0; b < bones.size(); ++b) {
            mesh->mBones[b] = new aiBone;
            mesh->mBones[b]->mName = bones[b];
            auto* const node = new aiNode(bones[b]);
            scene.mRootNode->addChildren(1, const_cast<aiNode**>(&node));
        }
    }
    void weigh(size_t bone, const std::vector<aiVertexWeight>& weights) {
        aiBone& to = *mesh->mBones[bone];
        to.mNumWeights = static_cast<unsigned>(weights.size());
        to.mWeights = new aiVertexWeight[weights.size()];
        std::copy(weights.begin(), weights.end(), to.mWeights);
    }
};

const std::string file = "a.glb";

TEST(MeshBones, FourOfMostWeightAreKept) {
    Scene given({"a", "b", "c", "d", "e"});
    const float weights[] = {0.05f, 0.4f, 0.2f, 0.25f, 0.1f};
    for (size_t b = 0; b < 5; ++b)
        given.weigh(b, {{0, weights[b]}, {1, b == 2 ? 3.0f : 0.0f}});
    RawMesh raw(std::pmr::get_default_resource());
    MeshBones bones(file, given.scene, 1, raw);
    std::pmr::vector<VertexSkin> skins;
    ASSERT_TRUE(bones.take(*given.mesh, *given.scene.mRootNode, skins).ok());
    ASSERT_EQ(skins.size(), 3u);
    EXPECT_EQ(skins[0].indices, (BoneIndices{1, 3, 2, 4}));
    for (size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(skins[0].weights[k], weights[skins[0].indices[k]] / 0.95f, 1e-6);
    EXPECT_EQ(skins[1].indices[0], 2u);
    EXPECT_EQ(skins[1].weights, (BoneWeights{1, 0, 0, 0})) << "scaled to sum 1";
    EXPECT_EQ(skins[2].weights, (BoneWeights{1, 0, 0, 0})) << "of no bone: the first";
    EXPECT_EQ(raw.skins_reduced, 2u);
    EXPECT_EQ(raw.first_reduced, "mesh \"face\", vertex 0: 5 bones, the four of most weight kept");
    EXPECT_EQ(raw.skin.bones.size(), 5u);
}

TEST(MeshBones, BonesThatAreAlikeAreOne) {
    Scene given({"a", "b"});
    RawMesh raw(std::pmr::get_default_resource());
    MeshBones bones(file, given.scene, 1, raw);
    std::pmr::vector<VertexSkin> skins;
    for (int time = 0; time < 2; ++time)
        ASSERT_TRUE(bones.take(*given.mesh, *given.scene.mRootNode, skins).ok());
    EXPECT_EQ(raw.skin.bones.size(), 2u);
    given.mesh->mBones[1]->mOffsetMatrix.a4 = 5; // bound in another place
    ASSERT_TRUE(bones.take(*given.mesh, *given.scene.mRootNode, skins).ok());
    EXPECT_EQ(raw.skin.bones.size(), 3u);
    EXPECT_EQ(raw.skin.bones[2].inverse_bind[3], 5);
}

TEST(MeshBones, WeightsAreDoubted) {
    const auto refused = [](aiVertexWeight weight, const char* text) {
        Scene given({"a", "b"});
        given.weigh(1, {weight});
        RawMesh raw(std::pmr::get_default_resource());
        MeshBones bones(file, given.scene, 1, raw);
        std::pmr::vector<VertexSkin> skins;
        const auto taken = bones.take(*given.mesh, *given.scene.mRootNode, skins);
        ASSERT_FALSE(taken.ok());
        EXPECT_EQ(taken.error().code, PLAIT_BAD_DATA);
        EXPECT_EQ(taken.error().message, std::string("a.glb: mesh \"face\": bone \"b\": ") + text);
    };
    refused({3, 1.0f}, "moves vertex 3; allowed 0 to 2");
    refused({1, -0.5f}, "weight of vertex 1 is -0.5; allowed 0 or more");
    refused({1, NAN}, "weight of vertex 1 is nan; allowed 0 or more");
}

TEST(MeshBones, LongNamesAreCutBetweenCharacters) {
    const auto cut = [](const std::string& name) { return std::string(bone_name(name).data()); };
    EXPECT_EQ(cut(std::string(63, 'a')), std::string(63, 'a'));
    EXPECT_EQ(cut(std::string(64, 'a')), std::string(63, 'a'));
    EXPECT_EQ(cut(std::string(62, 'a').append("\xc3\xa9")), std::string(62, 'a'));
}

} // namespace
} // namespace plait
#endif
