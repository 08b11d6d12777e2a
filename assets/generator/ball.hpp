// Hair in a layer on a ball: what limp hair that is to keep its volume is measured with.
#pragma once

#include "generator.hpp"
#include "path.hpp"
#include "scalp.hpp"

namespace plait_generator {

// Strands from the upper cap, down along the ball to its equator and then straight down, each at a
// distance of its own in a layer as thick as the style's volume.
class BallHair {
  public:
    explicit BallHair(const Style& style) : style_(style) {} // keeps the reference

    Path strand(uint32_t i) const; // of the style's vertices
    Uv uv(uint32_t i) const;       // of the root: seen from above, equal areas

  private:
    double polar(uint32_t i) const; // of the root, rad
    double own(uint64_t stream, uint32_t i) const;

    const Style& style_;
};

} // namespace plait_generator
