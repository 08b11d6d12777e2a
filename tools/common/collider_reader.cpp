#include "common/collider_reader.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>

namespace common {
namespace {

void read_capsule(JsonReader& in, plait_collider_desc& shape) {
    if (!in.numbers("a", shape.capsule.a, -1e6, 1e6))
        in.fail("a", "is missing: the capsule's first end, m");
    if (!in.numbers("b", shape.capsule.b, -1e6, 1e6)) // a sphere
        std::copy(std::begin(shape.capsule.a), std::end(shape.capsule.a),
                  std::begin(shape.capsule.b));
    if (!in.number("radius_a", shape.capsule.radius_a, 1e-9, 1e3))
        in.fail("radius_a", "is missing: the radius at a, m, in (0, 1000]");
    shape.capsule.radius_b = shape.capsule.radius_a;
    in.number("radius_b", shape.capsule.radius_b, 1e-9, 1e3);
}

void read_plane(JsonReader in, plait_collider_desc& shape) {
    shape.kind = PLAIT_COLLIDER_KIND_PLANE;
    in.numbers("point", shape.plane.point, -1e6, 1e6);
    if (!in.numbers("normal", shape.plane.normal, -1e6, 1e6))
        in.fail("normal", "is missing: where hair may be, of any length");
    if (!(std::hypot(shape.plane.normal[0], shape.plane.normal[1], shape.plane.normal[2]) >= 1e-6f))
        in.fail("normal", "is shorter than 1e-6");
    in.finish();
}

void read_box(JsonReader in, plait_collider_desc& shape) {
    shape.kind = PLAIT_COLLIDER_KIND_BOX;
    in.numbers("centre", shape.box.centre, -1e6, 1e6);
    if (!in.numbers("half_extents", shape.box.half_extents, 0, 1e3))
        in.fail("half_extents", "is missing: half the edges, m, each in [0, 1000]");
    in.number("rounding", shape.box.rounding, 0, 1e3);
    in.numbers("orientation", shape.box.orientation, -1, 1);
    double square = 0;
    for (const float q : shape.box.orientation)
        square += double(q) * double(q);
    if (!(std::abs(std::sqrt(square) - 1) <= 1e-3))
        in.fail("orientation", "is no unit quaternion, x y z w, within 0.001");
    in.finish();
}

} // namespace

plait_collider_desc smooth_collider() {
    plait_collider_desc desc = plait_collider_desc_defaults();
    desc.friction = 0;
    return desc;
}

plait_collider_desc read_collider(JsonReader& in, plait_collider_desc shape) {
    const Json* const plane = in.value("plane");
    const Json* const box = in.value("box");
    if (plane && box)
        in.fail("box", "stands beside plane: a collider is one of the two, or a capsule");
    if (plane)
        read_plane(in.object(*plane, "plane"), shape);
    else if (box)
        read_box(in.object(*box, "box"), shape);
    else
        read_capsule(in, shape);
    in.number("friction", shape.friction, 0, 10);
    return shape;
}

} // namespace common
