// A pin's target on its way, shared by the stages that move it.
#pragma once

#include "backend/reference/base/math.hpp"

namespace plait::reference {

// There is a way only between two pins of one frame, which is what the sign of the stiffness says.
inline Vec4 on_its_way(const Vec4& from, const Vec4& to, double share) {
    const bool same_frame = (from.w() > 0 && to.w() > 0) || (from.w() < 0 && to.w() < 0);
    Vec4 between = to;
    if (same_frame)
        between.head<3>() = (1 - share) * from.head<3>() + share * to.head<3>();
    return between;
}

} // namespace plait::reference
