// One dispatch: refuse what makes no sense, bind its buffers to the stage's views, perform it.
#pragma once

#include "base/result.hpp"

#include <plait/plait_backend.h>

namespace plait::reference {

// @errors INVALID_ARGUMENT: the message names the stage, the argument, the value and the range.
Status perform(const plait_dispatch& dispatch);

} // namespace plait::reference
