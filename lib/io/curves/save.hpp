// A groom as a file of curves that does not move.
#pragma once

#include "base/result.hpp"
#include "core/groom/strand_set.hpp"

#include <string>

namespace plait {

// IO, UNSUPPORTED.
Status save_curves(const std::string& path, const StrandSet& strands);

} // namespace plait
