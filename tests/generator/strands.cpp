// What every hairstyle keeps to.
#include "generator/scalp.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

namespace plait_generator {
namespace {

class Groom : public testing::TestWithParam<Hairstyle> {};

TEST_P(Groom, HasTheStrandsAndVerticesAskedFor) {
    for (const auto& [strands, vertices] : {std::pair{1u, 2u}, std::pair{7u, 256u}}) {
        Style style = make_style(GetParam());
        style.strands = strands;
        style.vertices = vertices;
        const Strands groom = make_groom(style);
        EXPECT_EQ(groom.vertex_counts, std::vector<uint32_t>(strands, vertices));
        EXPECT_EQ(groom.positions.size(), size_t{3} * strands * vertices);
        EXPECT_EQ(groom.uv.size(), size_t{2} * strands);
        EXPECT_EQ(groom.thickness.size(), strands);
    }
}

TEST_P(Groom, StartsOnTheScalpAndStaysOutOfTheHead) {
    const Strands groom = sample_groom(GetParam(), 300);
    for (size_t i = 0; i < groom.vertex_counts.size(); ++i) {
        const auto vertices = strand(groom, i);
        ASSERT_NEAR(head_distance(vertices[0]), 0, 1e-7) << "strand " << i;
        const bool beard = GetParam() == Hairstyle::Beard;
        ASSERT_GT(beard ? beard_height(vertices[0]) : scalp_height(vertices[0]), 0)
            << "strand " << i;
        for (size_t k = 1; k < vertices.size(); ++k)
            ASSERT_GT(head_distance(vertices[k]), 1e-4) << "strand " << i << ", vertex " << k;
    }
}

TEST_P(Groom, KeepsOutOfTheColliders) {
    const Strands groom = sample_groom(GetParam(), 100);
    for (const Capsule& capsule : head_colliders())
        for (size_t i = 0; i < groom.positions.size() / 3; ++i)
            ASSERT_GT(capsule_distance(capsule, point(groom.positions, i)), 0) << "vertex " << i;
}

TEST_P(Groom, HasSegmentsOfNearlyEqualLength) {
    const Strands groom = sample_groom(GetParam(), 300);
    for (size_t i = 0; i < groom.vertex_counts.size(); ++i) {
        const auto vertices = strand(groom, i);
        double least = 1, most = 0;
        for (size_t k = 1; k < vertices.size(); ++k) {
            const double segment = length(vertices[k] - vertices[k - 1]);
            least = std::min(least, segment);
            most = std::max(most, segment);
        }
        ASSERT_LT(most / least, 1.25) << "strand " << i;
    }
}

TEST_P(Groom, HasHairsOf70To90Micrometres) {
    for (const float diameter : sample_groom(GetParam(), 100).thickness) {
        ASSERT_GE(diameter, 70e-6f);
        ASSERT_LE(diameter, 90e-6f);
    }
}

TEST_P(Groom, FollowsTheSeed) {
    Style style = make_style(GetParam());
    style.strands = 20;
    const auto first = make_groom(style).positions;
    EXPECT_EQ(make_groom(style).positions, first);
    style.seed = 2;
    EXPECT_NE(make_groom(style).positions, first);
}

// FNV-1a of the positions' bits, as made on x86-64 with g++ 12: the same everywhere, see
// generator.hpp.
uint64_t hash(const std::vector<float>& values) {
    uint64_t h = 14695981039346656037u;
    for (const float value : values) {
        uint32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        for (int shift = 0; shift < 32; shift += 8)
            h = (h ^ ((bits >> shift) & 0xff)) * 1099511628211u;
    }
    return h;
}

TEST_P(Groom, IsTheSameOnEveryMachine) {
    const std::map<Hairstyle, uint64_t> recorded{
        {Hairstyle::Long, 4974389427263069814u},      {Hairstyle::Braid, 17392154593210895392u},
        {Hairstyle::Curly, 3660524837633576431u},     {Hairstyle::Short, 14649173939919187641u},
        {Hairstyle::Ponytail, 16217510357115207215u}, {Hairstyle::Bob, 10966711451026192638u},
        {Hairstyle::Afro, 6104579654218978027u},      {Hairstyle::Dreadlocks, 4978627783900250003u},
        {Hairstyle::Beard, 8607848173010376667u}};
    EXPECT_EQ(hash(sample_groom(GetParam(), 100).positions), recorded.at(GetParam()));
}

// Below the bust, which ends at 0.3 m, it hangs on, and does not turn in under it.
TEST(Ponytail, ALongTailHangs) {
    Style style = make_style(Hairstyle::Ponytail);
    style.strands = 100;
    style.tail_length = 0.8;
    const Strands strands = make_groom(style);
    const float* p = strands.positions.data();
    for (const uint32_t count : strands.vertex_counts) {
        for (uint32_t i = 1; i < count; ++i) {
            const float* const a = p + 3 * (i - 1);
            const float down = a[1] - a[4], length = std::hypot(a[3] - a[0], down, a[5] - a[2]);
            if (a[1] < -0.35f) {
                ASSERT_GT(down, 0.7f * length) << "vertex " << i;
            }
        }
        p += 3 * size_t{count};
    }
}

INSTANTIATE_TEST_SUITE_P(All, Groom, testing::ValuesIn(all_hairstyles), [](const auto& instance) {
    return std::string(hairstyle_name(instance.param));
});

TEST(Style, DefaultsAreValid) {
    for (const Hairstyle hairstyle : all_hairstyles) {
        EXPECT_EQ(make_style(hairstyle).hairstyle, hairstyle);
        EXPECT_EQ(style_problem(make_style(hairstyle)), "");
    }
}

TEST(Style, NamesTheFieldItsValueAndItsRange) {
    Style style;
    style.strands = 0;
    EXPECT_EQ(style_problem(style), "strands is 0; its range is [1, 1000000]");
    style = Style{};
    style.vertices = 257;
    EXPECT_EQ(style_problem(style), "vertices is 257; its range is [2, 256]");
    for (const StyleField& field : style_fields()) {
        style = Style{};
        style.*field.value = field.most * 1.01;
        EXPECT_EQ(style_problem(style).find(field.name), 0u) << field.name;
        style.*field.value = field.least - 1e-4;
        EXPECT_EQ(style_problem(style).find(field.name), 0u) << field.name;
        style.*field.value = std::nan("");
        EXPECT_EQ(style_problem(style).find(field.name), 0u) << field.name;
    }
}

} // namespace
} // namespace plait_generator
