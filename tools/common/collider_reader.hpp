// A collider's shape as keys of a JSON object.
#pragma once

#include "common/json_fwd.hpp"

#include <plait/plait.h>

namespace common {

// Without friction, as the references are.
plait_collider_desc smooth_collider();

// A capsule: a, b (absent: a sphere), radius_a, radius_b (absent: radius_a). Or "plane", an object
// of point and normal; or "box", one of centre, half_extents, rounding, orientation. And friction. What is absent is as in `shape`.
// The caller reads what else there is, and calls finish().
plait_collider_desc read_collider(JsonReader& in, plait_collider_desc shape);

} // namespace common
