// Which collider a vertex touches, and where. Ours: tangent planes of the first crossing.
#include "backend/reference/contact/contact.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {

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

// Under a surface that holds the root deeper, a vertex need come no farther out of it than half the
// length from the root.
Contacts::Touch Contacts::touch(const Collider& collider, size_t vertex, const Vec3& x) const {
    Touch found = touch_surface(collider, vertex, x);
    const double root_depth = -collider.surface(motion_.root).distance;
    if (found.gap < 0) {
        const double sunk = std::max(root_depth - PLAIT_CONTACT_ROOT_CLEARANCE * arc_[vertex], 0.0);
        found.gap += sunk;
        found.start += sunk;
    }
    return found;
}

Contacts::Touch Contacts::touch_surface(const Collider& collider, size_t vertex,
                                        const Vec3& x) const {
    const Vec3 start = motion_.root + motion_.start[vertex], end = motion_.root + x;
    const Vec3 anchor = collider.carried(start);
    const Surface at_anchor = collider.surface(anchor), at_end = collider.surface(end);
    Touch nearest{at_end.distance, at_anchor.distance, collider.friction, at_end.normal,
                  anchor - motion_.root};
    if (collider.inward) // what is inside of a convex body is above all its tangents
        return nearest;
    Touch swept = nearest;
    bool crosses = true;
    if (at_anchor.distance > 0) {
        const auto plane = first_crossing(collider, anchor, end);
        crosses = plane.has_value();
        if (crosses) {
            swept.normal = plane->normal;
            swept.gap = plane->height;
        }
    } else {
        swept.normal = at_anchor.normal;
        swept.gap = at_anchor.distance + at_anchor.normal.dot(end - anchor);
    }
    if (!crosses)
        return nearest;
    const bool inside = at_anchor.distance < -PLAIT_CONTACT_TOLERANCE * length_[vertex];
    const bool beyond = at_anchor.distance > 0 && at_end.distance > 0;
    const bool other_side = !(at_end.normal.dot(swept.normal) > PLAIT_SWEEP_SAME_SIDE);
    return inside || beyond || other_side ? swept : nearest;
}

// No farther from the collider than from where it would have carried the vertex.
bool Contacts::meets(const Collider& collider, size_t vertex, const Vec3& x) const {
    const Vec3 end = motion_.root + x;
    const Vec3 anchor = collider.carried(motion_.root + motion_.start[vertex]);
    return clearance(collider, end) <=
           (end - anchor).norm() + PLAIT_CONTACT_TOLERANCE * length_[vertex];
}

std::optional<Contacts::Touch> Contacts::nearest(size_t vertex, const Vec3& x) const {
    std::optional<Touch> best;
    for (size_t index = 0; index < params_.collider_count; ++index) {
        const Collider collider = collider_at(colliders_, params_.collider_first + index);
        if (!meets(collider, vertex, x))
            continue;
        const Touch candidate = touch(collider, vertex, x);
        if (!best || candidate.gap < best->gap)
            best = candidate;
    }
    if (planes_.empty() || !planes_[vertex])
        return best;
    const MeshPlane& plane = *planes_[vertex];
    const double gap = plane.height + plane.normal.dot(x - plane.anchor);
    if (!best || gap < best->gap)
        best = Touch{gap, plane.start, plane.friction, plane.normal, plane.anchor};
    return best;
}

} // namespace plait::reference
