// How differently neighbours move, on strands whose speeds are known.
#include "neighbours.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// Three strands of 3 vertices side by side along x, at 0, 1 and 3 mm; the third moves by `move` m.
std::vector<float> strands(float move) {
    std::vector<float> positions;
    for (int strand = 0; strand < 3; ++strand)
        for (int vertex = 0; vertex < 3; ++vertex) {
            const float x = strand == 0 ? 0.0f : strand == 1 ? 0.001f : 0.003f;
            const float moved = strand == 2 && vertex > 0 ? move : 0.0f;
            for (const float value : {x, -0.1f * static_cast<float>(vertex), moved, 1.0f})
                positions.push_back(value);
        }
    return positions;
}

TEST(Neighbours, speeds_are_relative_to_the_nearest) {
    const std::vector<uint32_t> counts(3, 3);
    simulate::Neighbours neighbours(strands(0.0f), counts, 3);
    EXPECT_EQ(neighbours.rms_speed(), 0.0);
    neighbours.add(strands(0.0f), 0.1f);
    EXPECT_EQ(neighbours.rms_speed(), 0.0) << "nothing moved";
    // Of three pairs one moves, at 0.02 m in 0.1 s, in one of two frames.
    neighbours.add(strands(0.02f), 0.1f);
    EXPECT_NEAR(neighbours.rms_speed(), 0.2 / std::sqrt(6.0), 1e-6);
}

TEST(Neighbours, all_moving_alike_are_at_rest) {
    const std::vector<uint32_t> counts(3, 3);
    simulate::Neighbours neighbours(strands(0.0f), counts, 3);
    std::vector<float> moved = strands(0.0f);
    for (size_t i = 0; i < moved.size(); i += 4)
        moved[i + 1] += 0.5f;
    neighbours.add(moved, 0.1f);
    EXPECT_NEAR(neighbours.rms_speed(), 0.0, 1e-5);
}

TEST(Neighbours, one_strand_has_none) {
    const std::vector<float> positions(8, 0.0f);
    const std::vector<uint32_t> counts(1, 2);
    simulate::Neighbours neighbours(positions, counts, 2);
    neighbours.add(positions, 0.1f);
    EXPECT_EQ(neighbours.rms_speed(), 0.0);
}

} // namespace
