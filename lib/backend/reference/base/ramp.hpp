// A ramp: knots at the root, a third, two thirds of the length and the tip, linear between.
#pragma once

#include <algorithm>
#include <cstddef>

namespace plait::reference {

inline double ramp(const float (&knots)[4], double share) {
    const double at = 3 * share;
    const auto knot = static_cast<size_t>(std::clamp(at, 0.0, 2.0));
    return knots[knot] + (at - double(knot)) * (double(knots[knot + 1]) - knots[knot]);
}

} // namespace plait::reference
