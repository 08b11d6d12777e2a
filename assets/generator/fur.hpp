// Fur all over the ball.
#pragma once

#include "generator.hpp"
#include "path.hpp"
#include "scalp.hpp"

namespace plait_generator {

// Strands that leave the ball at a slant, all combed towards its lower pole.
class FurHair {
  public:
    explicit FurHair(const Style& style) : style_(style) {} // keeps the reference

    Path strand(uint32_t i) const; // of the style's vertices
    Uv uv(uint32_t i) const;       // of the root: seen from above, equal areas

  private:
    Vec3 normal(uint32_t i) const; // of the ball at the root
    double own(uint64_t stream, uint32_t i) const;

    const Style& style_;
};

} // namespace plait_generator
