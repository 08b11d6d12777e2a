// The caller's accelerations on their way into a part's push.
#pragma once

#include "core/base/part.hpp"
#include "core/base/schedule.hpp"

namespace plait {

// Once per fixed step, and not with wind, whose own stage adds them.
void append_accelerations(Schedule& schedule, const Part& part);

} // namespace plait
