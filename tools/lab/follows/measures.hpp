// What is measured of hair in motion, strand by strand in the groom's order.
#pragma once

#include "follows.hpp"

#include <span>

namespace lab::follows {

using Point = Eigen::Vector3f;

// [strands][row], padding included.
struct Hair {
    uint32_t row = 0;
    std::vector<uint32_t> counts;
    std::vector<Point> x;

    size_t strands() const { return counts.size(); }
    const Point* strand(size_t s) const { return &x[s * row]; }
    const Point& tip(size_t s) const { return strand(s)[counts[s] - 1]; }
};

class Measures {
  public:
    // `simulated`: of every strand, whether it is.
    Measures(const Hair& rest, std::vector<bool> simulated);

    // One frame more; `truth`: where all strands are simulated.
    void add(const Hair& now, const Hair& truth);
    void finish(FollowRow& row); // all but the cost

  private:
    struct Pair {
        size_t strand, other;
    };
    void add_segments(const Hair& now);
    void add_steps(const Hair& now);
    void add_neighbours(const Hair& now);

    Hair rest_, before_;
    std::vector<bool> simulated_;
    std::vector<Pair> pairs_;
    std::vector<double> beside_;
    std::vector<double> curve_; // m
    double length_ = 0, kink_ = 0, step_ = 0;
    double farthest_ = 0; // m^2
};

} // namespace lab::follows
