// Follow strands turned out of a body with distance f, segment after segment from the root:
//   x_i = x_(i-1) + r_i, and where f(x_i) < o_i a turn of r_i in the plane of r_i and the normal n that
//   brings r_i.n to r_i.n + o_i - f(x_i), or to STEEPEST |r_i| where that is less; twice
//   o_i = min(0, min(0, f(x_0)) + s arc_i)
// Ours.
#pragma once

#include "backend/reference/base/lanes.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace plait::reference {

struct FollowGap {
    double distance; // negative inside
    Vec3 normal;
};

inline Vec3 lifted(const Vec3& segment, const Vec3& normal, double lift) {
    const double size = segment.norm(), along = segment.dot(normal);
    const Vec3 across = segment - along * normal;
    if (!(across.norm() > 1e-6 * size))
        return segment;
    const double up = std::min(along + lift, std::max(PLAIT_FOLLOW_STEEPEST * size, along));
    const Vec3 turned =
        up * normal + std::sqrt(std::max(size * size - up * up, 0.0)) * across.normalized();
    return size / turned.norm() * turned; // where `across` is small, the normal's rounding is not
}

// Of the strand whose row begins at `row`. What needs no turn is not written. `gap_at(x, bound)`: nothing
// if the surface is surely farther than `bound`, m, or has no normal there.
template <typename GapAt>
void leave(const View<Vec4>& position, size_t row, size_t stride, const GapAt& gap_at) {
    Vec3 before = xyz(position[row]), shift = Vec3::Zero();
    const std::optional<FollowGap> root = gap_at(before, double{PLAIT_MESH_ROOT_DEPTH});
    const double depth = root ? std::min(root->distance, 0.0) : 0;
    double arc = 0;
    bool moved = false;
    for (size_t i = 1; i < stride; ++i) {
        const Vec3 now = xyz(position[row + i]), from = before + shift;
        Vec3 segment = now - before;
        before = now;
        const double size = segment.norm();
        arc += size;
        const double offset = std::min(depth + PLAIT_CONTACT_ROOT_CLEARANCE * arc, 0.0);
        for (int turn = 0; turn < PLAIT_FOLLOW_TURNS && size > 0; ++turn) {
            const std::optional<FollowGap> gap = gap_at(from + segment, 2 * size - depth);
            if (!gap || !(gap->distance < offset))
                break;
            segment = lifted(segment, gap->normal, offset - gap->distance);
            shift = from + segment - now;
            moved = true;
        }
        if (moved)
            set_xyz(position[row + i], now + shift);
    }
}

template <typename GapAt>
void leave_all(uint32_t follows, const plait_follow_collide_params& params,
               const View<const uint32_t>& lane_strand, const View<Vec4>& position,
               const GapAt& gap_at) {
    const size_t stride = params.vertex_stride;
    for (size_t lane = 0; lane < follows; ++lane)
        leave(position, (params.guide_count + strand_of(lane_strand, lane)) * stride, stride,
              gap_at);
}

} // namespace plait::reference
