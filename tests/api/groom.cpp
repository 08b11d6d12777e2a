// Grooms: what is mended, what is refused, and that mending hardly shows.
#include "support.hpp"

#include <limits>

namespace {

plait_groom_info describe(const Strands& strands) {
    return make_groom(strands).describe();
}

TEST(Groom, KeepsWhatNeedsNoMending) {
    Strands strands = tuft(3, 6);
    strands[1].resize(4);
    const auto groom = make_groom(strands);
    const auto info = groom.describe();
    EXPECT_EQ(info.strands, 3u);
    EXPECT_EQ(info.vertices, 16u);
    EXPECT_EQ(info.min_vertices, 4u);
    EXPECT_EQ(info.max_vertices, 6u);
    EXPECT_EQ(info.repairs_total, 0u);
    EXPECT_STREQ(info.first_repair, "");
    EXPECT_EQ(groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS), GroomArrays(strands).positions);
}

TEST(Groom, MeasuresBoundsAndLengths) {
    const auto info = describe({{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}, {{0, 0, 1}, {0, 0, 2}}});
    EXPECT_FLOAT_EQ(info.mean_length, 4);
    EXPECT_FLOAT_EQ(info.max_length, 7);
    EXPECT_EQ(info.bounds_max[1], 4);
    EXPECT_EQ(info.bounds_max[2], 2);
    EXPECT_EQ(info.bounds_min[0], 0);
}

TEST(Groom, DropsStrandsThatAreNotFinite) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 2e6f}) {
        Strands strands = tuft(3, 5);
        strands[1][2][1] = bad;
        const auto info = describe(strands);
        EXPECT_EQ(info.strands, 2u);
        EXPECT_EQ(info.repairs[PLAIT_REPAIR_NONFINITE], 1u);
        EXPECT_EQ(std::string(info.first_repair).rfind("strand 1, vertex 2", 0), 0u);
    }
}

TEST(Groom, DropsStrandsWithoutLength) {
    Strands strands = tuft(4, 5);
    strands[0].resize(1);
    strands[2] = Strand(5, Point{1, 1, 1});
    const auto info = describe(strands);
    EXPECT_EQ(info.strands, 2u);
    EXPECT_EQ(info.repairs[PLAIT_REPAIR_SHORT_STRAND], 2u);
}

float shortest(const std::vector<float>& p) {
    float least = INFINITY;
    for (size_t i = 3; i < p.size(); i += 3)
        least =
            std::min(least, std::hypot(p[i] - p[i - 3], p[i + 1] - p[i - 2], p[i + 2] - p[i - 1]));
    return least;
}

TEST(Groom, MovesVerticesOffZeroSegmentsAlongTheStrand) {
    for (size_t repeated : {size_t{1}, size_t{3}, size_t{5}}) {
        Strands strands = tuft(1, 6);
        strands[0][repeated] = strands[0][repeated - 1];
        const auto groom = make_groom(strands);
        const auto info = groom.describe();
        EXPECT_EQ(info.repairs[PLAIT_REPAIR_ZERO_SEGMENT], 1u);
        const auto mended = groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
        EXPECT_GT(shortest(mended), 0.9e-3f * info.mean_length / 5);
        EXPECT_LT(largest_difference(mended, GroomArrays(strands).positions),
                  1.1e-3f * info.mean_length / 5);
        EXPECT_NEAR(info.mean_length, describe({strands[0]}).mean_length, 1e-6);
    }
}

TEST(Groom, CountsTinySegmentsByTheirShareOfTheMean) {
    Strands strands = {{{0, 0, 0}, {1, 0, 0}, {1.0005f, 0, 0}, {2, 0, 0}}};
    EXPECT_EQ(describe(strands).repairs[PLAIT_REPAIR_TINY_SEGMENT], 1u);
    strands[0][2][0] = 1.0008f; // the limit is 1e-3 of 2/3 m
    EXPECT_EQ(describe(strands).repairs_total, 0u);
}

TEST(Groom, KeepsAndCountsDuplicateRoots) {
    Strands strands = tuft(3, 4);
    strands[2] = strands[0];
    const auto info = describe(strands);
    EXPECT_EQ(info.strands, 3u);
    EXPECT_EQ(info.repairs[PLAIT_REPAIR_DUPLICATE_ROOT], 1u);
}

TEST(Groom, ResamplesLongStrandsTo256) {
    Strand strand;
    for (int i = 0; i <= 510; ++i) // every other vertex stays
        strand.push_back({0.001f * static_cast<float>(i), 0, 0});
    const auto groom = make_groom({strand});
    const auto info = groom.describe();
    EXPECT_EQ(info.max_vertices, 256u);
    EXPECT_EQ(info.repairs[PLAIT_REPAIR_TOO_LONG], 1u);
    EXPECT_EQ(info.repairs_total, 1u);
    const auto p = groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS);
    for (size_t i = 0; i < 256; ++i)
        EXPECT_NEAR(p[3 * i], 0.002 * static_cast<double>(i), 1e-6);
}

TEST(Groom, ResamplesByArcLengthOnRequest) {
    const GroomArrays arrays({{{0, 0, 0}, {1, 0, 0}, {4, 0, 0}}});
    auto options = plait_import_options_defaults();
    options.resample = 5;
    const plait::Groom groom(arrays.desc(), options);
    const std::vector<float> expected = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0};
    EXPECT_EQ(groom.read<float>(PLAIT_GROOM_FIELD_POSITIONS), expected);
    EXPECT_EQ(groom.describe().repairs_total, 0u);
}

TEST(Groom, RefusesInsteadOfMendingWhenAsked) {
    auto options = plait_import_options_defaults();
    options.policy = PLAIT_REPAIR_POLICY_REFUSE;
    Strands strands = tuft(2, 5);
    strands[1][3] = strands[1][2];
    plait_groom* groom = nullptr;
    const GroomArrays arrays(strands);
    const auto desc = arrays.desc();
    EXPECT_EQ(plait_groom_create(&desc, &options, &groom), PLAIT_BAD_DATA);
    EXPECT_EQ(groom, nullptr);
    EXPECT_NE(std::string(plait_last_error()).find("strand 1, vertex 3"), std::string::npos)
        << plait_last_error();
}

TEST(Groom, ScalesToMetresAndReadsStrides) {
    const std::vector<float> padded = {0, 0, 0, 9, 100, 0, 0, 9};
    auto desc = plait_groom_desc_defaults();
    desc.positions = {padded.data(), 2, 16};
    desc.vertices_per_strand = 2;
    auto options = plait_import_options_defaults();
    options.scale = 0.01f;
    EXPECT_FLOAT_EQ(plait::Groom(desc, options).describe().max_length, 1);
}

} // namespace
