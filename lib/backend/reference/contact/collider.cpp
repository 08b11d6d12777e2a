#include "backend/reference/contact/collider.hpp"

#include <plait/constants.h>
#include <plait/params.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plait::reference {

Surface surface(const Plane& plane, const Vec3& x) {
    return {plane.normal.dot(x - plane.point), plane.normal};
}

Surface surface(const Box& box, const Vec3& x) {
    const Vec3 local = box.orientation.conjugate() * (x - box.centre);
    const Vec3 beyond = local.cwiseAbs() - box.half; // each face's plane
    const Vec3 sides = local.unaryExpr([](double v) { return v < 0 ? -1.0 : 1.0; });
    const Vec3 out = sides.cwiseProduct(beyond.cwiseMax(0));
    if (out.norm() > 1e-15)
        return {out.norm() - box.rounding, box.orientation * out.normalized()};
    Eigen::Index axis;
    const double nearest = beyond.maxCoeff(&axis);
    return {nearest - box.rounding, box.orientation * Vec3(sides[axis] * Vec3::Unit(axis))};
}

Surface surface(const Hull& hull, const Vec3& x) {
    const Vec3 local = hull.around.orientation.conjugate() * (x - hull.around.centre);
    Surface highest{-std::numeric_limits<double>::infinity(), Vec3::Zero()};
    for (const auto& [normal, distance] : hull.faces)
        if (const double height = normal.dot(local) - distance; height > highest.distance)
            highest = {height, normal};
    return {highest.distance - hull.margin, hull.around.orientation * highest.normal};
}

Surface Collider::surface(const Vec3& x) const {
    const Surface at =
        std::visit([&](const auto& shape) { return reference::surface(shape, x); }, body);
    return inward ? Surface{-at.distance, -at.normal} : at;
}

// Newton's method from outside comes to the first zero and not beyond.
std::optional<Tangent> first_crossing(const Collider& collider, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    double t = 0;
    Surface at = collider.surface(from);
    for (int k = 0; k < PLAIT_SWEEP_STEPS; ++k) {
        const double slope = at.normal.dot(way);
        if (slope >= 0)
            return {};
        t += std::max(at.distance, 0.0) / -slope;
        if (t >= 1)
            return {};
        at = collider.surface(from + t * way);
    }
    return Tangent{at.normal, at.distance + (1 - t) * at.normal.dot(way)};
}

double clearance(const Collider& collider, const Vec3& x) {
    if (collider.inward)
        return collider.surface(x).distance;
    if (const Hull* hull = std::get_if<Hull>(&collider.body))
        return std::max(surface(*hull, x).distance, surface(hull->around, x).distance);
    const Capsule* capsule = std::get_if<Capsule>(&collider.body);
    if (!capsule)
        return collider.surface(x).distance;
    Capsule wide = *capsule;
    if ((wide.b - wide.a).norm() <= std::abs(wide.ra - wide.rb)) // one sphere holds the other
        wide.a = wide.b = wide.ra < wide.rb ? wide.b : wide.a;
    wide.ra = wide.rb = std::max(wide.ra, wide.rb);
    return surface(wide, x).distance;
}

Collider collider_at(const View<const Vec4>& buffer, size_t index) {
    const auto at = [&](size_t row) -> Vec4 { return buffer[index * PLAIT_COLLIDER_STRIDE + row]; };
    const Vec4 begin = at(PLAIT_COLLIDER_BEGIN), first = at(PLAIT_COLLIDER_END);
    const Vec4 second = at(PLAIT_COLLIDER_END + 1), last = at(PLAIT_COLLIDER_FRICTION);
    const bool inward = last.y() >= double{PLAIT_KIND_INWARD};
    const double kind = last.y() - (inward ? double{PLAIT_KIND_INWARD} : 0);
    Collider collider{Capsule{xyz(first), xyz(second), first.w(), second.w()},
                      xyz(begin),
                      xyz(first),
                      quat(at(PLAIT_COLLIDER_TURN)),
                      last.x(),
                      inward};
    if (kind == double{PLAIT_KIND_PLANE})
        collider.body = Plane{xyz(first), xyz(second)};
    else if (kind == double{PLAIT_KIND_BOX})
        collider.body = Box{xyz(first), xyz(second), quat(at(PLAIT_COLLIDER_BEGIN + 1)), first.w()};
    else if (kind == double{PLAIT_KIND_HULL}) {
        Hull hull{{xyz(first), xyz(second), quat(at(PLAIT_COLLIDER_BEGIN + 1)), 0}, {}, first.w()};
        const size_t begins =
            index * PLAIT_COLLIDER_STRIDE + static_cast<size_t>(std::lround(last.z()));
        for (size_t i = 0; i < static_cast<size_t>(std::lround(last.w())); ++i) {
            const Vec4 face = buffer[begins + i];
            hull.faces.push_back({xyz(face), face.w()});
        }
        collider.body = hull;
    }
    return collider;
}

} // namespace plait::reference
