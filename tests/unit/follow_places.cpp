// Where on a guide the middles of a follow's segments are.
#include "core/follows/follow_places.hpp"

#include "core/groom/strand_set.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

// Straight strands from `at` on along (1, 2, 2)/3, whose segments are so long, one after another.
plait::StrandSet strands_of(float at, const std::vector<std::vector<double>>& lengths) {
    plait::StrandSet strands;
    for (const auto& strand : lengths) {
        double arc = 0;
        strands.vertex_counts.push_back(static_cast<uint32_t>(strand.size() + 1));
        for (size_t i = 0; i <= strand.size(); ++i) {
            for (const double share : {1.0, 2.0, 2.0})
                strands.positions.push_back(at + static_cast<float>(arc * share / 3));
            arc += i < strand.size() ? strand[i] : 0;
        }
    }
    return strands;
}

std::vector<float> places(const plait::StrandSet& strands, size_t guide, size_t follow) {
    const auto middles = plait::middles_of(strands.positions, strands.vertex_counts,
                                           std::pmr::new_delete_resource());
    std::vector<float> places;
    for (const double share : middles.of(follow))
        places.push_back(plait::place_in(middles.of(guide), share));
    return places;
}

TEST(FollowPlaces, lie_between_the_middles_of_the_guide) {
    const auto strands = strands_of(0, {{1, 1, 1, 1}, {2, 1, 1}, {1, 3}});
    // middles of the guide at 1/8, 3/8, 5/8, 7/8
    EXPECT_EQ(places(strands, 0, 1), (std::vector<float>{0.5f, 2, 3}));
    EXPECT_EQ(places(strands, 0, 2), (std::vector<float>{0, 2}));
    EXPECT_EQ(places(strands, 1, 0), (std::vector<float>{0, 0.3333333333f, 1, 2}));
}

// Two metres from the origin, where positions are rounded to 2e-7 m, segments of 2 cm.
TEST(FollowPlaces, beside_a_middle_are_on_it) {
    const std::vector<double> even(15, 0.02), shorter(15, 0.0171);
    const auto strands = strands_of(2, {even, shorter});
    std::vector<float> whole;
    for (int i = 0; i < 15; ++i)
        whole.push_back(static_cast<float>(i));
    EXPECT_EQ(places(strands, 0, 1), whole);
    EXPECT_EQ(places(strands, 1, 0), whole);
}

} // namespace
