// How strands are divided by length.
#include "core/strands/length_classes.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using Counts = std::vector<uint32_t>;

Counts rows_of(const Counts& counts) {
    const plait::LengthClasses classes(counts, std::pmr::get_default_resource());
    return {classes.rows().begin(), classes.rows().end()};
}

Counts strands_of(std::initializer_list<std::pair<size_t, uint32_t>> kinds) {
    Counts counts;
    for (const auto& [strands, vertices] : kinds)
        counts.insert(counts.end(), strands, vertices);
    return counts;
}

// Rows that the strands take.
uint64_t total(const Counts& counts) {
    const plait::LengthClasses classes(counts, std::pmr::get_default_resource());
    return std::accumulate(counts.begin(), counts.end(), uint64_t{0},
                           [&](uint64_t sum, uint32_t count) {
                               EXPECT_GE(classes.row_of(count), count);
                               return sum + classes.row_of(count);
                           });
}

TEST(LengthClasses, StrandsOfOneLengthAreOne) {
    EXPECT_EQ(rows_of({2}), Counts{2});
    EXPECT_EQ(rows_of(Counts(100000, 16)), Counts{16});
    EXPECT_EQ(rows_of(Counts(100000, 256)), Counts{256});
}

TEST(LengthClasses, AreAsManyAsPay) {
    EXPECT_EQ(rows_of(strands_of({{1000, 8}, {1000, 64}})), (Counts{8, 64}));
    EXPECT_EQ(rows_of(strands_of({{9000, 16}, {1, 256}})), (Counts{16, 256}));
    EXPECT_EQ(rows_of(strands_of({{3000, 8}, {3000, 64}, {3000, 256}})), (Counts{8, 64, 256}));
    EXPECT_EQ(rows_of(strands_of({{30000, 8}, {8000, 32}, {2000, 128}, {1000, 256}})),
              (Counts{8, 32, 128, 256}));
    EXPECT_EQ(
        rows_of(strands_of({{99999, 4}, {9999, 16}, {5000, 64}, {2000, 128}, {1000, 256}})).size(),
        4u); // and no more
}

TEST(LengthClasses, ThatSaveLittleAreNotMade) {
    EXPECT_EQ(rows_of(strands_of({{70, 8}, {70, 64}})), Counts{64});       // 3920 rows
    EXPECT_EQ(rows_of(strands_of({{1000, 8}, {100000, 64}})), Counts{64}); // 56000 of 6464000
    EXPECT_EQ(rows_of(strands_of({{5000, 15}, {5000, 16}})), Counts{16});  // 5000 of 160000
}

// Of every length as many: a half, and not a third, which would save a tenth of what is left.
TEST(LengthClasses, OfEvenlySpreadLengthsAreTwo) {
    Counts counts;
    for (uint32_t v = 8; v <= 64; ++v)
        counts.insert(counts.end(), 100, v);
    const Counts rows = rows_of(counts);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1], 64u);
    // 57 lengths in a class of n and one of 57 - n: least n (7 + n) + (57 - n) 64
    EXPECT_TRUE(rows[0] == 35 || rows[0] == 36) << rows[0];
    EXPECT_EQ(total(counts), 100u * (28 * 35 + 29 * 64));
}

TEST(LengthClasses, DoNotDependOnTheOrderOfStrands) {
    Counts counts = strands_of({{700, 9}, {300, 40}, {500, 17}});
    const Counts rows = rows_of(counts);
    std::reverse(counts.begin(), counts.end());
    EXPECT_EQ(rows_of(counts), rows);
    EXPECT_EQ(total(counts), uint64_t{700} * 9 + 300 * 40 + 500 * 17);
}

} // namespace
