// Where hair grows.
#pragma once

#include "vec.hpp"

#include <cstdint>
#include <vector>

namespace plait_generator {

// Height above the hairline, m; positive where hair grows. For points on the mannequin's surface.
double scalp_height(Vec3 p);
// The same of a beard: inside of its border on jaw, chin and upper lip.
double beard_height(Vec3 p);

// Evenly spread points on the scalp, or where a beard grows, in random order.
std::vector<Vec3> scatter_roots(size_t count, uint64_t seed, bool beard = false);

// Lambert's azimuthal equal-area map of the direction from the skull's middle, crown in the centre.
struct Uv {
    double u, v; // [0, 1]
};
Uv scalp_uv(Vec3 root);
Uv equal_area(Vec3 direction); // the map itself; `direction`: unit

} // namespace plait_generator
