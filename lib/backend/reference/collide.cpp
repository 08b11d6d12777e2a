// collide: push vertices out of tapered capsules, with Coulomb friction.
// A capsule is the hull of two spheres, that is the union of the spheres c(k), r(k) with k in [0,
// 1]. f(k) = |x - c(k)| - r(k) is convex, its minimum is the signed distance of x inside and
// outside, and the normal points from c(k) to x. Friction takes at most mu * (push depth) off the
// tangential part of the vertex's displacement relative to the surface, and never reverses it
// (Mueller et al. 2007, section 3.4, with the depth in place of a restitution model).
#include "backend/reference/stages.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

struct Capsule {
    Vec3 a, b;
    double ra, rb;

    Vec3 centre(double k) const { return a + k * (b - a); }
    double radius(double k) const { return ra + k * (rb - ra); }
};

struct Contact {
    double k;        // foot on the axis
    double distance; // to the surface, negative inside
    Vec3 normal;
};

Capsule capsule_at(const View<const Vec4>& buffer, size_t collider, double alpha) {
    const size_t first = collider * PLAIT_CAPSULE_STRIDE;
    const Vec4 a = (1 - alpha) * buffer[first] + alpha * buffer[first + 2];
    const Vec4 b = (1 - alpha) * buffer[first + 1] + alpha * buffer[first + 3];
    return {xyz(a), xyz(b), a.w(), b.w()};
}

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

Contact contact(const Capsule& capsule, const Vec3& x) {
    const double k = foot(capsule, x);
    const Vec3 out = x - capsule.centre(k);
    const Vec3 normal = out.isZero(0) ? normal_on_axis(capsule) : direction(out);
    return {k, out.norm() - capsule.radius(k), normal};
}

Vec3 rub(const Vec3& x, const Vec3& relative, const Contact& at, double friction) {
    const Vec3 tangential = relative - relative.dot(at.normal) * at.normal;
    const double slip = tangential.norm();
    if (slip == 0)
        return x;
    return x - tangential * std::min(1.0, friction * -at.distance / slip);
}

} // namespace

void collide(uint32_t item_count, const plait_collide_params& params, const collide_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = place(item, params.vertex_stride);
        Vec4& position = args.position[item];
        if (i >= vertices_of(args.vertex_count, strand, params.vertex_stride) || pinned(position))
            continue;
        for (size_t collider = 0; collider < params.collider_count; ++collider) {
            const Capsule before = capsule_at(args.capsule, collider, params.alpha_from);
            const Capsule now = capsule_at(args.capsule, collider, params.alpha_to);
            const Contact at = contact(now, xyz(position));
            if (!(at.distance < 0))
                continue;
            const Vec3 pushed = xyz(position) - at.distance * at.normal;
            const Vec3 surface_motion = now.centre(at.k) - before.centre(at.k);
            const Vec3 relative = pushed - xyz(args.position_prev[item]) - surface_motion;
            const double friction = args.capsule[collider * PLAIT_CAPSULE_STRIDE + 4].x();
            set_xyz(position, rub(pushed, relative, at, friction));
        }
    }
}

} // namespace plait::reference
