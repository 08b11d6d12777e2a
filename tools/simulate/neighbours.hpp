// How differently hairs move that grow beside each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace simulate {

class Neighbours {
  public:
    // `rest`: [strands][row][4], m. Follows at most so many strands, each with that whose root is
    // nearest.
    Neighbours(std::span<const float> rest, std::span<const uint32_t> vertex_count, uint32_t row);

    // Where the first frame comes from, instead of `rest`.
    void start(std::span<const float> positions) { keep(positions); }

    // One more frame, `step` s after the one before.
    void add(std::span<const float> positions, float step);

    // Of the frames so far; with the last one's positions all that the others need.
    struct Sum {
        double squares = 0.0; // of speeds, (m/s)^2
        uint64_t count = 0;
    };
    const Sum& sum() const { return sum_; }
    void go_on(std::span<const float> positions, const Sum& sum) {
        keep(positions);
        sum_ = sum;
    }

    double rms_speed() const; // m/s, of all frames and vertices; 0: there are none

  private:
    struct Pair {
        uint32_t strand, other, vertices; // those both have
    };
    std::array<float, 3> apart(std::span<const float> positions, Pair pair, uint32_t vertex) const;
    void keep(std::span<const float> positions);

    uint32_t row_;
    std::vector<Pair> pairs_;
    std::vector<std::array<float, 3>> before_; // what lay between each pair's vertices
    Sum sum_;
};

} // namespace simulate
