// A collider's shape as keys of a JSON object.
#pragma once

#include "common/json_reader.hpp"

#include <plait/plait.h>

namespace common {

// a, b (absent: a sphere), radius_a, radius_b (absent: radius_a), friction. The caller reads what
// else there is, and calls finish().
plait_collider_desc read_capsule(JsonReader& in);

} // namespace common
