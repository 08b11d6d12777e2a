// Springs of a part: what pins hold vertices with, and what holds strands in their groom.
#pragma once

#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/strands/state.hpp"

namespace plait {

// `groom`: the slider of the params, [0, 1].
void fill_springs(Schedule& schedule, const Part& part, const State& state, float groom,
                  Doors& doors);

} // namespace plait
