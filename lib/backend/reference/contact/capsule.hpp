// A tapered capsule is the hull of two spheres, that is the union of the spheres c(k), r(k) with k
// in [0, 1]. f(k) = |x - c(k)| - r(k) is convex, its minimum is the signed distance of x inside and
// outside, and the normal points from c(k) to x.
#pragma once

#include "backend/reference/base/math.hpp"

namespace plait::reference {

struct Capsule {
    Vec3 a, b;
    double ra, rb;

    Vec3 centre(double k) const { return a + k * (b - a); }
    double radius(double k) const { return ra + k * (rb - ra); }
};

// What a point sees of a collider.
struct Surface {
    double distance; // to the surface, negative inside
    Vec3 normal;
};

Surface surface(const Capsule& capsule, const Vec3& x);

} // namespace plait::reference
