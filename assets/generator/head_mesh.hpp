// The mannequin as triangles, as coarse as one likes.
#pragma once

#include "generator.hpp"

namespace plait_generator {

// Detail 1 of make_head() is 2.6, 2 is 1.3.
HeadMesh make_head_of(double spacing);

} // namespace plait_generator
