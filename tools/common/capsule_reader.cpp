#include "common/capsule_reader.hpp"

#include <algorithm>

namespace common {

plait_collider_desc read_capsule(JsonReader& in) {
    plait_collider_desc shape = plait_collider_desc_defaults();
    if (!in.numbers("a", shape.a, -1e6, 1e6))
        in.fail("a", "is missing: the capsule's first end, m");
    if (!in.numbers("b", shape.b, -1e6, 1e6)) // a sphere
        std::copy(std::begin(shape.a), std::end(shape.a), std::begin(shape.b));
    if (!in.number("radius_a", shape.radius_a, 1e-9, 1e3))
        in.fail("radius_a", "is missing: the radius at a, m, in (0, 1000]");
    shape.radius_b = shape.radius_a;
    in.number("radius_b", shape.radius_b, 1e-9, 1e3);
    in.number("friction", shape.friction, 0, 10);
    return shape;
}

} // namespace common
