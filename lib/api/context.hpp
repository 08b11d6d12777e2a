// Making contexts, for plait.h and for plait_opencl.h.
#pragma once

#include "core/sim/context.hpp"

namespace plait::api {

// Checks a descriptor (NULL: all defaults).
Result<ContextRules> context_rules(const plait_context_desc* given);

Result<plait_context*> make_context(const ContextRules& rules);

} // namespace plait::api
