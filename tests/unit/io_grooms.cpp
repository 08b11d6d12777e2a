// The readers on real grooms.
#include "../real_groom.hpp"
#include "io_support.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

bool all_finite(const std::pmr::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

// What was read is written in `name`'s format, read again and compared.
void expect_survives(const StrandSet& strands, const char* name) {
    TemporaryDirectory directory;
    const std::string path = directory.file(name);
    ASSERT_OK(write_strands(path, strands));
    auto again = read_strands(path);
    ASSERT_OK(again);
    EXPECT_EQ(again->vertex_counts, strands.vertex_counts);
    EXPECT_EQ(again->positions, strands.positions);
    EXPECT_EQ(again->strand_uv, strands.strand_uv);
    EXPECT_EQ(again->bone_indices, strands.bone_indices);
    EXPECT_EQ(again->bone_weights, strands.bone_weights);
}

TEST(IoGrooms, SintelOf16Vertices) {
    const std::string path = real_groom("sintel_16.tfx");
    PLAIT_SKIP_WITHOUT(path);
    auto strands = read_strands(path);
    ASSERT_OK(strands);
    ASSERT_EQ(strands->vertex_counts.size(), 11400u);
    EXPECT_EQ(strands->vertex_counts.back(), 16u);
    ASSERT_EQ(strands->positions.size(), 3u * 16 * 11400);
    EXPECT_TRUE(all_finite(strands->positions));
    EXPECT_TRUE(strands->strand_uv.empty());
    EXPECT_TRUE(strands->bone_indices.empty());
    // Bytes 160 to 172 of the file.
    EXPECT_EQ(strands->positions[0], std::bit_cast<float>(0xbd297ca9u));
    EXPECT_EQ(strands->positions[1], std::bit_cast<float>(0x3fc06fe6u));
    EXPECT_EQ(strands->positions[2], std::bit_cast<float>(0xbd799783u));
    expect_survives(*strands, "sintel.tfx");
    expect_survives(*strands, "sintel.hair");
}

TEST(IoGrooms, RatboysBody) {
    const std::string path = real_groom("ratboy_body.tfxmesh");
    PLAIT_SKIP_WITHOUT(path);
    const auto body = read_mesh(path);
    ASSERT_OK(body);
    EXPECT_EQ(body->surface.positions.size(), 12909u);
    EXPECT_EQ(body->surface.triangles.size(), 25814u);
    ASSERT_EQ(body->skin.bones.size(), 86u);
    EXPECT_STREQ(body->skin.bones[5].name.data(), "frenchHornMonster_head_JNT");
    ASSERT_EQ(body->skin.indices.size(), 12909u);
    for (const BoneWeights& weights : body->skin.weights)
        EXPECT_NEAR(weights[0] + weights[1] + weights[2] + weights[3], 1, 1e-6);
}

TEST(IoGrooms, RatboyWithStrandUvAndSkin) {
    const std::string path = real_groom("ratboy_mohawk.tfx");
    PLAIT_SKIP_WITHOUT(path);
    auto strands = read_strands(path);
    ASSERT_OK(strands);
    ASSERT_EQ(strands->vertex_counts.size(), 2228u);
    EXPECT_EQ(strands->vertex_counts.front(), 32u);
    ASSERT_EQ(strands->positions.size(), 3u * 32 * 2228);
    EXPECT_TRUE(all_finite(strands->positions));
    ASSERT_EQ(strands->strand_uv.size(), 2u * 2228);
    for (float value : strands->strand_uv)
        EXPECT_TRUE(value >= 0.0f && value <= 1.0f) << value;
    expect_survives(*strands, "mohawk.tfx");
}

TEST(IoGrooms, RatboyIsSkinnedToTheBonesOfItsFile) {
    const std::string path = real_groom("ratboy_mohawk.tfx");
    PLAIT_SKIP_WITHOUT(path);
    PLAIT_SKIP_WITHOUT(path + "bone"); // ratboy_mohawk.tfxbone
    auto strands = read_strands(path);
    ASSERT_OK(strands);
    ASSERT_EQ(strands->bone_indices.size(), 4u * 2228);
    ASSERT_EQ(strands->bone_weights.size(), 4u * 2228);
    EXPECT_EQ(*std::max_element(strands->bone_indices.begin(), strands->bone_indices.end()), 101u);
    for (size_t s = 0; s < 2228; ++s) {
        const float* w = &strands->bone_weights[4 * s];
        EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1.0f, 1e-6f) << "strand " << s;
    }
}

} // namespace
} // namespace plait
