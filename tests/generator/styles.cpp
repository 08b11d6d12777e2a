// What makes each hairstyle what it is called.
#include "generator/braid.hpp"
#include "generator/fall.hpp"
#include "generator/scalp.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <string>

namespace plait_generator {
namespace {

// ---- parting

TEST(Parted, HairLeavesThePartingToBothSides) {
    Style style = make_style(Hairstyle::Long);
    style.strands = 4000;
    style.vertices = 64;
    const Strands groom = make_groom(style);
    size_t near_part = 0;
    for (size_t i = 0; i < style.strands; ++i) {
        const auto vertices = strand(groom, i);
        const double from_part = vertices[0].x - style.part;
        if (std::abs(from_part) > 0.01 || vertices[0].z < 0)
            continue;
        ++near_part;
        for (size_t k : {3u, 8u}) // 2 and 5 cm along
            ASSERT_GT((vertices[k].x - vertices[0].x) * from_part, 0) << "strand " << i;
    }
    EXPECT_GT(near_part, 50u);
}

TEST(Parted, LongHairFallsBelowTheShouldersAndLeavesTheFaceFree) {
    const Strands groom = sample_groom(Hairstyle::Long, 1000);
    double lowest = 0;
    for (size_t i = 0; i < groom.positions.size() / 3; ++i) {
        const Vec3 p = point(groom.positions, i);
        lowest = std::min(lowest, p.y);
        const bool before_face = p.z > 0.05 && std::abs(p.x) < 0.035 && p.y < 0.04 && p.y > -0.1;
        ASSERT_FALSE(before_face) << "vertex " << i;
    }
    EXPECT_LT(lowest, -0.28);
}

// ---- braid

struct Crossing {
    char sides;  // which two of left, middle and right change places: 'l' or 'r' of the middle
    double over; // how far the one that comes from that side passes in front, m
};

// The bundles seen from behind: each time two of them change places across the braid.
std::vector<Crossing> crossings(const BraidedHair& braid, const Style& style) {
    std::vector<Crossing> found;
    std::array<uint32_t, 3> order{};
    for (double along = 0; along < 0.9 * style.braid_length; along += 1e-4) {
        std::array<uint32_t, 3> now{0, 1, 2};
        const auto x = [&](uint32_t bundle) { return braid.bundle_middle(bundle, along).x; };
        std::sort(now.begin(), now.end(), [&](uint32_t a, uint32_t b) { return x(a) < x(b); });
        if (along > 0 && now != order) {
            const bool low = now[0] != order[0];
            const uint32_t outer = low ? order[0] : order[2]; // comes in from the side
            const Vec3 gap =
                braid.bundle_middle(outer, along) - braid.bundle_middle(order[1], along);
            found.push_back({low ? 'l' : 'r', -gap.z}); // z points away from the one who looks
        }
        order = now;
    }
    return found;
}

class BraidTest : public testing::Test {
  protected:
    BraidTest()
        : style_(make_style(Hairstyle::Braid)), roots_(scatter_roots(300, style_.seed)),
          braid_(style_, roots_) {}

    Style style_;
    std::vector<Vec3> roots_;
    BraidedHair braid_;
};

// The plait: the outer bundle passes on the same side of the middle one each time, left and right
// in turn.
TEST_F(BraidTest, OuterBundlesCrossTheMiddleOneInTurn) {
    const auto found = crossings(braid_, style_);
    const double periods = 0.9 * style_.braid_length / style_.braid_pitch;
    ASSERT_NEAR(static_cast<double>(found.size()), 6 * periods, 1.01);
    const double radius = style_.bundle_radius;
    for (size_t i = 0; i < found.size(); ++i) {
        if (i > 0) {
            EXPECT_NE(found[i].sides, found[i - 1].sides) << "crossing " << i;
        }
        EXPECT_GT(found[i].over * found[0].over, 0) << "crossing " << i;
        EXPECT_GT(std::abs(found[i].over), radius) << "crossing " << i;
    }
}

TEST_F(BraidTest, BundlesTouchAndDoNotRunThroughEachOther) {
    for (double along = 0; along < 0.9 * style_.braid_length; along += 1e-3) {
        double nearest = 1;
        for (double other = along - 0.03; other < along + 0.03; other += 5e-4)
            for (uint32_t bundle = 0; bundle < 3; ++bundle)
                nearest = std::min(
                    nearest, length(braid_.bundle_middle(bundle, along) -
                                    braid_.bundle_middle((bundle + 1) % 3, std::max(other, 0.0))));
        const double radius = braid_.bundle_radius(along);
        EXPECT_GT(nearest, 1.4 * radius) << along << " m along";
        EXPECT_LT(nearest, 2.35 * radius) << along << " m along";
    }
}

TEST_F(BraidTest, StrandsStayInTheirBundle) {
    std::array<size_t, 3> members{};
    for (uint32_t i = 0; i < roots_.size(); ++i) {
        const uint32_t bundle = braid_.bundle(i);
        ++members[bundle];
        for (const Vec3 p : braid_.strand(i)) {
            if (p.y > -0.2 || p.y < -0.28)
                continue;
            double nearest = 1, radius = 0;
            for (double along = 0.08; along < 0.3; along += 1e-3) {
                const double gap = length(p - braid_.bundle_middle(bundle, along));
                if (gap < nearest) {
                    nearest = gap;
                    radius = braid_.bundle_radius(along);
                }
            }
            ASSERT_LT(nearest, 1.02 * radius) << "strand " << i;
        }
    }
    for (const size_t count : members)
        EXPECT_NEAR(static_cast<double>(count), 100, 15);
}

// ---- curls

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Turn {
    double radius, pitch;
};

// Of the helix through equally spaced points a, b, c, d: its second difference points to the axis.
Turn helix_through(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 to_axis_b = a - 2 * b + c, to_axis_c = b - 2 * c + d;
    const Vec3 axis = unit(cross(to_axis_b, to_axis_c));
    const Vec3 m = unit(to_axis_b), n = unit(to_axis_c);
    const double angle = std::atan2(length(cross(m, n)), dot(m, n));
    const double radius = length(to_axis_b) / (2 * (1 - std::cos(angle)));
    return {radius, 2 * pi * std::abs(dot(c - b, axis)) / angle};
}

TEST(Curls, HaveTheRadiusAndPitchOfTheStyle) {
    Style style = make_style(Hairstyle::Curly);
    style.strands = 200;
    style.vertices = 256;
    style.length = 0.3;
    style.length_variation = 0;
    style.curl_variation = 0;
    style.stray = 0;
    style.clump_tightness = 1;
    for (const auto& [radius, pitch] : {std::pair{0.006, 0.024}, std::pair{0.012, 0.04}}) {
        style.curl_radius = radius;
        style.curl_pitch = pitch;
        const Strands groom = make_groom(style);
        std::vector<double> radii, pitches;
        for (size_t i = 0; i < style.strands; ++i) {
            const auto v = strand(groom, i);
            if (v[0].y < 0.04) // those that hang free below
                continue;
            for (size_t k = 150; k + 12 < v.size(); ++k) {
                const Turn turn = helix_through(v[k], v[k + 4], v[k + 8], v[k + 12]);
                radii.push_back(turn.radius);
                pitches.push_back(turn.pitch);
            }
        }
        EXPECT_NEAR(median(radii), radius, 0.008 * radius);
        EXPECT_NEAR(median(pitches), pitch, 0.008 * pitch);
    }
}

// Else the weight of the curls would draw them down before the eyes.
TEST(Curls, AboveTheBrowAreCutToAFringe) {
    const Strands groom = sample_groom(Hairstyle::Curly, 1000);
    std::vector<double> above_brow, elsewhere;
    for (size_t i = 0; i < 1000; ++i) {
        const std::vector<Vec3> v = strand(groom, i);
        const bool fringe = v[0].z > 0.06 && std::abs(v[0].x) < 0.03;
        (fringe ? above_brow : elsewhere).push_back(path_length(v));
    }
    ASSERT_GT(above_brow.size(), 10u);
    EXPECT_LT(median(above_brow), 0.6 * median(elsewhere));
}

} // namespace
} // namespace plait_generator
