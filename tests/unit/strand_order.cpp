// The order in which strands take lanes: every strand once, neighbours side by side.
#include "core/base/strand_order.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace {

using Order = std::pmr::vector<uint32_t>;

// Of strands of 2 to 5 vertices with these roots.
Order order_of(const std::vector<std::array<float, 3>>& roots) {
    std::vector<float> positions;
    std::vector<uint32_t> counts;
    for (const auto& root : roots) {
        counts.push_back(static_cast<uint32_t>(2 + counts.size() % 4));
        for (uint32_t k = 0; k < counts.back(); ++k)
            positions.insert(positions.end(), {root[0], root[1] - 0.1f * float(k), root[2]});
    }
    return plait::order_by_root(positions, counts, std::pmr::new_delete_resource());
}

TEST(StrandOrder, follows_a_line_of_roots_whatever_their_numbers) {
    EXPECT_EQ(order_of({{0.3f, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0, 0, 0}}), Order({3, 1, 2, 0}));
    EXPECT_EQ(order_of({{0, 2, -8}, {0, 2, 3}, {0, 2, -9}}), Order({2, 0, 1}));
}

TEST(StrandOrder, keeps_strands_of_one_root_as_they_come) {
    EXPECT_EQ(order_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), Order({0, 1, 2}));
    EXPECT_EQ(order_of({{1, 1, 1}}), Order({0}));
}

// 4,096 roots on a unit sphere are .05 apart; at random two in a row are 4/3 apart.
TEST(StrandOrder, brings_neighbours_together) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    std::vector<std::array<float, 3>> roots(4096);
    for (auto& p : roots) {
        for (float& c : p)
            c = normal(random);
        const float size = std::hypot(p[0], p[1], p[2]);
        for (float& c : p)
            c /= size;
    }
    const Order order = order_of(roots);
    std::vector<int> seen(roots.size());
    double apart = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        ++seen[order[i]];
        if (i > 0) {
            const auto &a = roots[order[i - 1]], &b = roots[order[i]];
            apart += double(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])) / 4095;
        }
    }
    EXPECT_EQ(seen, std::vector<int>(roots.size(), 1));
    EXPECT_LT(apart, 0.15);
}

} // namespace
