// The nearest point of a triangle mesh that bends, and on which side of it a point is: by all of its
// triangles. Sources: Ericson 2005, 5.1.5; sides by Baerentzen & Aanaes 2005.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plait::reference {

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    size_t triangle = 0;
    Vec3 shares = Vec3::Zero(); // of the corners
    Vec3 point = Vec3::Zero();
};

struct SurfaceSample {
    double distance; // negative inside
    Vec3 normal;
    bool rim;
    Vec3 point; // the nearest
};

inline Vec3 unit(const Vec3& v) {
    return v.norm() > 0 ? Vec3(v / v.norm()) : Vec3(Vec3::Zero());
}

// Of a segment, its share.
inline double nearest_share(const Vec3& from, const Vec3& to, const Vec3& x) {
    const Vec3 way = to - from;
    return std::clamp(way.dot(x - from) / way.squaredNorm(), 0.0, 1.0);
}

// Its triangles at a share of the fixed step.
template <typename Args> class MeshSurface {
  public:
    MeshSurface(const Args& args, size_t mesh) : args_(args) {
        const auto first = [&](size_t what) {
            return size_t{args.mesh_first[mesh * PLAIT_MESH_FIRST_STRIDE + what]};
        };
        triangle_ = first(PLAIT_MESH_FIRST_TRIANGLE);
        vertex_ = first(PLAIT_MESH_FIRST_VERTEX);
        two_sided = first(PLAIT_MESH_FIRST_TWO_SIDED) != 0;
        bends = args.mesh_bends[mesh];
        count_ = first(PLAIT_MESH_FIRST_COUNT);
    }

    Vec3 corner(size_t triangle, size_t k, double share) const {
        return vertex(word(triangle, k), share);
    }
    Vec3 face(size_t triangle, double share) const {
        const Vec3 a = corner(triangle, 0, share);
        return (corner(triangle, 1, share) - a).cross(corner(triangle, 2, share) - a);
    }

    std::optional<Nearest> nearest(const Vec3& x, double share, double bound) const {
        Nearest best;
        best.distance = bound;
        bool found = false;
        for (size_t t = 0; t < count_; ++t) {
            const Vec3 p[3] = {corner(t, 0, share), corner(t, 1, share), corner(t, 2, share)};
            const Vec3 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]),
                       high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
            if ((low - x).cwiseMax(x - high).cwiseMax(0.0).norm() > best.distance)
                continue;
            const Vec3 shares = shares_of(p, x);
            const Vec3 point = shares[0] * p[0] + shares[1] * p[1] + shares[2] * p[2];
            if (const double distance = (x - point).norm(); distance < best.distance) {
                best = {distance, t, shares, point};
                found = true;
            }
        }
        return found ? std::optional(best) : std::nullopt;
    }

    std::optional<SurfaceSample> at(const Vec3& x, double share, double bound) const {
        const auto found = nearest(x, share, bound);
        if (!found)
            return {};
        bool rim = false;
        const Vec3 outward = outward_of(*found, share, rim), way = x - found->point;
        const double sign = way.dot(outward) < 0 ? -1 : 1;
        const bool round = found->shares.minCoeff() <= 0 && found->distance > PLAIT_MESH_TOUCH;
        return SurfaceSample{sign * found->distance, unit(round ? Vec3(sign * way) : outward), rim,
                             found->point};
    }

    // Does the straight way from a to b pass through a triangle, or by its edge?
    bool passed(const Vec3& a, const Vec3& b, double share) const {
        for (size_t t = 0; t < count_; ++t) {
            Eigen::Matrix3d m;
            m << corner(t, 1, share) - corner(t, 0, share),
                corner(t, 2, share) - corner(t, 0, share), a - b;
            const Vec3 s = m.inverse() * (a - corner(t, 0, share));
            if (std::abs(m.determinant()) > 0 && s[2] >= 0 && s[2] <= 1 &&
                s[0] >= -PLAIT_MESH_EDGE && s[1] >= -PLAIT_MESH_EDGE &&
                s[0] + s[1] <= 1 + PLAIT_MESH_EDGE)
                return true;
        }
        return false;
    }

    // Where what is at x at one share is at another.
    Vec3 carried(const Nearest& under, const Vec3& x, double begin, double end, double most) const {
        Vec3 point = Vec3::Zero();
        for (size_t k = 0; k < 3; ++k)
            point += under.shares[static_cast<Eigen::Index>(k)] * corner(under.triangle, k, end);
        bool rim = false;
        const Vec3 from = outward_of(under, begin, rim), to = outward_of(under, end, rim);
        if (!(from.norm() > 0 && to.norm() > 0))
            return x;
        const Vec3 moved = point + turn(from, to) * (x - under.point) - x;
        return x + moved * std::min(1.0, most / std::max(moved.norm(), 1e-9));
    }

    bool two_sided;
    double bends;

  private:
    size_t word(size_t triangle, size_t k) const {
        return args_.mesh_triangle[(triangle_ + triangle) * PLAIT_MESH_TRIANGLE_STRIDE + k];
    }
    Vec3 vertex(size_t index, double share) const {
        const Vec3 from = xyz(args_.mesh_from[vertex_ + index]);
        return from + share * (xyz(args_.mesh_to[vertex_ + index]) - from);
    }

    // Of the corners, of the nearest point: inside where the plane's foot is, else on an edge.
    static Vec3 shares_of(const Vec3 (&p)[3], const Vec3& x) {
        const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
        Vec3 shares;
        for (Eigen::Index k = 0; k < 3; ++k)
            shares[k] = (p[(k + 2) % 3] - p[(k + 1) % 3]).cross(x - p[(k + 1) % 3]).dot(normal) /
                        normal.squaredNorm();
        if (shares.minCoeff() > 0)
            return shares;
        double least = std::numeric_limits<double>::infinity();
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Vec3 &from = p[k], &to = p[(k + 1) % 3];
            const double share = nearest_share(from, to, x);
            const double distance = (from + share * (to - from) - x).norm();
            if (!(distance < least))
                continue;
            least = distance;
            shares.setZero();
            shares[k] = 1 - share;
            shares[(k + 1) % 3] = share;
        }
        return shares;
    }

    Vec3 outward_of(const Nearest& found, double share, bool& rim) const {
        for (size_t k = 0; k < 3; ++k)
            if (found.shares[static_cast<Eigen::Index>(k)] >= 1)
                return outward_of_corner(word(found.triangle, k), share, rim);
        const Vec3 own = face(found.triangle, share);
        for (size_t k = 0; k < 3; ++k)
            if (found.shares[static_cast<Eigen::Index>(k)] <= 0) {
                const size_t other = word(found.triangle, 3 + (k + 1) % 3);
                rim = other == PLAIT_MESH_NO_TRIANGLE;
                return unit(own) + (rim ? Vec3(Vec3::Zero()) : unit(face(other, share)));
            }
        return own;
    }

    Vec3 outward_of_corner(size_t index, double share, bool& rim) const {
        Vec3 sum = Vec3::Zero();
        for (size_t t = 0; t < count_; ++t)
            for (size_t k = 0; k < 3; ++k) {
                if (word(t, k) != index)
                    continue;
                const Vec3 a = corner(t, (k + 1) % 3, share) - corner(t, k, share),
                           b = corner(t, (k + 2) % 3, share) - corner(t, k, share);
                sum += unit(a.cross(b)) * std::atan2(a.cross(b).norm(), a.dot(b));
                rim = rim || word(t, 3 + k) == PLAIT_MESH_NO_TRIANGLE ||
                      word(t, 3 + (k + 2) % 3) == PLAIT_MESH_NO_TRIANGLE;
            }
        return sum;
    }

    const Args& args_;
    size_t triangle_, vertex_, count_;
};

} // namespace plait::reference
