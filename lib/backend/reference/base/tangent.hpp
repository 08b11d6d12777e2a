// The tangent of a vertex: the direction to the next. A segment of no length takes the direction of
// the nearest one towards the root that has some, else of the nearest towards the tip, else +y: a
// tangent is always a unit vector.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <algorithm>

namespace plait::reference {

// Of vertex i of the strand of `count` vertices from `root` on; the last and those after it have
// that of the last segment.
inline Vec3 tangent(const View<Vec4>& position, size_t root, uint32_t i, uint32_t count) {
    const auto direction_of = [&](size_t segment) {
        return direction(xyz(position[root + segment + 1]) - xyz(position[root + segment]));
    };
    const uint32_t segment = std::min(i, count - 2);
    for (uint32_t back = 0; back <= segment; ++back)
        if (Vec3 d = direction_of(segment - back); !d.isZero(0))
            return d;
    for (uint32_t next = segment + 1; next + 1 < count; ++next)
        if (Vec3 d = direction_of(next); !d.isZero(0))
            return d;
    return Vec3::UnitY();
}

} // namespace plait::reference
