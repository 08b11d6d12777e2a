#include "generator/scalp.hpp"
#include "generator/scatter.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace plait_generator {
namespace {

std::vector<double> nearest_gaps(const std::vector<Vec3>& points) {
    std::vector<double> gaps;
    for (size_t i = 0; i < points.size(); ++i) {
        double nearest = 1e9;
        for (size_t j = 0; j < points.size(); ++j)
            if (j != i)
                nearest = std::min(nearest, length(points[i] - points[j]));
        gaps.push_back(nearest);
    }
    return gaps;
}

struct Spread {
    double mean, variation; // the coefficient of variation
};
Spread spread(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double value : values)
        sum += value;
    const double n = static_cast<double>(values.size()), mean = sum / n;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / n) / mean};
}

TEST(Roots, AsManyAsAskedFor) {
    for (const size_t count : {1u, 2u, 7u, 100u, 10000u})
        EXPECT_EQ(scatter_roots(count, 1).size(), count);
}

TEST(Roots, LieOnTheScalp) {
    for (const Vec3 root : scatter_roots(2000, 3)) {
        ASSERT_LT(std::abs(head_distance(root)), 1e-8);
        ASSERT_GT(scalp_height(root), 0);
    }
}

// Of random points, gaps vary by 0.52 (Rayleigh); of Poisson-disk samples by elimination, by 0.11.
TEST(Roots, AreEvenlySpaced) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        const std::vector<double> gaps = nearest_gaps(scatter_roots(3000, seed));
        const Spread gap = spread(gaps);
        EXPECT_LT(gap.variation, 0.125);
        EXPECT_GT(*std::min_element(gaps.begin(), gaps.end()), 0.75 * gap.mean);
    }
}

TEST(Roots, FollowTheSeed) {
    const auto a = scatter_roots(50, 1), b = scatter_roots(50, 2);
    EXPECT_GT(length(a[0] - b[0]), 1e-6);
}

TEST(Roots, HaveTheirOwnPlaceInTheScalpMap) {
    const auto roots = scatter_roots(1000, 1);
    for (size_t i = 0; i < roots.size(); ++i) {
        const Uv a = scalp_uv(roots[i]);
        ASSERT_TRUE(a.u > 0 && a.u < 1 && a.v > 0 && a.v < 1);
        const Uv b = scalp_uv(roots[(i + 1) % roots.size()]);
        const double apart = std::sqrt((a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v));
        ASSERT_GT(apart, 0.5 * length(roots[i] - roots[(i + 1) % roots.size()])) << "root " << i;
    }
}

TEST(PointGrid, FindsEveryPointWithinReachOnce) {
    const auto points = scatter_roots(500, 5);
    const PointGrid grid(points, 0.02);
    for (const Vec3 p : points) {
        std::vector<int> seen(points.size(), 0);
        grid.for_each_near(p, [&](uint32_t i) { ++seen[i]; });
        for (size_t i = 0; i < points.size(); ++i)
            ASSERT_TRUE(seen[i] == 1 || (seen[i] == 0 && length(points[i] - p) > 0.02));
    }
}

} // namespace
} // namespace plait_generator
