#include "backend/reference/contact/capsule.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// The minimiser of f. With t along the axis and rho away from it, the foot of a point outside the
// two caps lies rho tan(phi) back along the axis, sin(phi) = (ra - rb) / |b - a|.
double foot(const Capsule& capsule, const Vec3& x) {
    const double length = (capsule.b - capsule.a).norm();
    const double taper = capsule.ra - capsule.rb;
    if (length <= std::abs(taper))
        return taper >= 0 ? 0 : 1; // one sphere holds the other
    const Vec3 axis = (capsule.b - capsule.a) / length;
    const Vec3 from_a = x - capsule.a;
    const double t = from_a.dot(axis);
    const double rho = (from_a - t * axis).norm();
    const double tan_phi = taper / std::sqrt(length * length - taper * taper);
    return std::clamp((t - rho * tan_phi) / length, 0.0, 1.0);
}

// On the axis every direction around it is as near; the angle to it is that of the side's normals.
Vec3 normal_on_axis(const Capsule& capsule) {
    const Vec3 axis = capsule.b - capsule.a;
    const double sin_phi = (capsule.ra - capsule.rb) / axis.norm();
    if (!(std::abs(sin_phi) < 1))
        return Vec3::UnitX();
    return sin_phi * axis.normalized() + std::sqrt(1 - sin_phi * sin_phi) * axis.unitOrthogonal();
}

} // namespace

Surface surface(const Capsule& capsule, const Vec3& x) {
    const double k = foot(capsule, x);
    const Vec3 out = x - capsule.centre(k);
    const Vec3 normal = out.isZero(0) ? normal_on_axis(capsule) : direction(out);
    return {out.norm() - capsule.radius(k), normal};
}

} // namespace plait::reference
