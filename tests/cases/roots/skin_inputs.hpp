// What the cases of the stages that make poses of roots share.
#pragma once

#include "inputs.hpp"

namespace plait::cases {

// Of buffer 4, the poses: rotations to 5e-6, q and -q being one, and translations to 2e-5 m.
std::string compare_poses(const Setup& setup, const Outputs& expected, const Outputs& got);

} // namespace plait::cases
