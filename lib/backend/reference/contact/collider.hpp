// Colliders of every kind: convex bodies that move as one piece. Each knows its signed distance f
// and the normal of the nearest surface; f is convex, so that every tangent plane of it keeps to
// the outside.
#pragma once

#include "backend/reference/contact/capsule.hpp"

#include <optional>
#include <variant>
#include <vector>

namespace plait::reference {

// All x with normal.(x - point) <= 0.
struct Plane {
    Vec3 point, normal;
};

// All points within `rounding` of the box of these half extents.
struct Box {
    Vec3 centre, half;
    Quat orientation; // from the box's axes to the world
    double rounding;
};

// All x under each of its faces, `margin` farther out. Beyond edges f is less than the distance.
struct Hull {
    struct Face {
        Vec3 normal;     // in the hull's axes
        double distance; // from its centre
    };
    Box around; // of all of it, without rounding
    std::vector<Face> faces;
    double margin;
};

Surface surface(const Plane& plane, const Vec3& x);
// Inside the box, which its rounding is added to, the surface is that of the nearest face.
Surface surface(const Box& box, const Vec3& x);

// That of the face that is highest below x, or least deep above it.
Surface surface(const Hull& hull, const Vec3& x);

using Body = std::variant<Capsule, Plane, Box, Hull>;

// A collider over a substep.
struct Collider {
    Body body;     // at the end
    Vec3 from, to; // a point of it, at the begin and at the end
    Quat turn;     // from begin to end
    double friction;
    bool inward = false; // hair stays inside: f and the normal are turned round

    Surface surface(const Vec3& x) const;
    // Where it carries a point of the begin, and whence it carried one.
    Vec3 carried(const Vec3& x) const { return to + turn * (x - from); }
    Vec3 carried_from(const Vec3& x) const { return from + turn.conjugate() * (x - to); }
};

// At least this far from a collider, and from most no farther than that: of a capsule with the
// greater radius all along, of a hull also of the box around it.
double clearance(const Collider& collider, const Vec3& x);

// A tangent plane of a collider's distance: `height` of the end of the way above it.
struct Tangent {
    Vec3 normal;
    double height;
};

// Where the way, along which the distance is convex, first crosses the surface; nothing if it ends or turns
// away before. Ours: tangent planes of the first crossing.
std::optional<Tangent> first_crossing(const Collider& collider, const Vec3& from, const Vec3& to);

Collider collider_at(const View<const Vec4>& buffer, size_t index);

} // namespace plait::reference
