// Segments of strands: where two of them are nearest, in float64.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <algorithm>

namespace plait::reference {

struct Segment {
    Vec3 from, to;
    Vec3 at(double share) const { return from + share * (to - from); }
    Vec3 middle() const { return at(0.5); }
    double length() const { return (to - from).norm(); }
};

inline Segment segment_at(const View<const Vec4>& position, size_t vertex) {
    return {xyz(position[vertex]), xyz(position[vertex + 1])};
}

// What its points have moved by.
inline Segment moves_of(const View<const Vec4>& now, const View<const Vec4>& before,
                        size_t vertex) {
    const Segment a = segment_at(now, vertex), b = segment_at(before, vertex);
    return {a.from - b.from, a.to - b.to};
}

struct Foot {
    double s, t; // along the first and along the second
    Vec3 apart;  // from the second to the first
};

// The least of |a(s) - b(t)|: inside, where both derivatives vanish, or on the rim, where an end of
// one segment is nearest to the other. Of parallel ones the middle of the first if that is over the
// second.
inline Foot nearest(const Segment& a, const Segment& b) {
    const Vec3 u = a.to - a.from, v = b.to - b.from;
    const auto share_of = [](const Segment& segment, const Vec3& point) {
        const Vec3 way = segment.to - segment.from;
        const double square = way.squaredNorm();
        return square > 0 ? std::clamp(way.dot(point - segment.from) / square, 0.0, 1.0) : 0.0;
    };
    const auto foot_at = [&](double s, double t) -> Foot { return {s, t, a.at(s) - b.at(t)}; };
    Eigen::Matrix2d normal;
    normal << u.dot(u), -u.dot(v), -u.dot(v), v.dot(v);
    const Vec3 between = a.from - b.from;
    if (normal.determinant() > 1e-6 * u.dot(u) * v.dot(v)) {
        const Eigen::Vector2d inside =
            normal.inverse() * Eigen::Vector2d(-u.dot(between), v.dot(between));
        if (inside.minCoeff() >= 0 && inside.maxCoeff() <= 1)
            return foot_at(inside[0], inside[1]);
    } else if (v.squaredNorm() > 0) {
        const double t = v.dot(a.middle() - b.from) / v.squaredNorm();
        if (t >= 0 && t <= 1)
            return foot_at(0.5, t);
    }
    Foot best = foot_at(0, share_of(b, a.from));
    for (const Foot& other : {foot_at(1, share_of(b, a.to)), foot_at(share_of(a, b.from), 0),
                              foot_at(share_of(a, b.to), 1)})
        if (other.apart.squaredNorm() < best.apart.squaredNorm())
            best = other;
    return best;
}

} // namespace plait::reference
