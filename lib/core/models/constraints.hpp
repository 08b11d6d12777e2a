// Constraints on positions that more than one model can have: each appends its stage, or nothing
// where the parameters turn it off.
#pragma once

#include "core/model.hpp"

namespace plait {

bool has_global_shape(const plait_sim_params& params);
bool has_local_shape(const plait_sim_params& params);
bool has_attachment(const plait_sim_params& params);

void add_global_shape(Schedule& schedule, const Substep& at);
void add_local_shape(Schedule& schedule, const Substep& at);
void add_attachment(Schedule& schedule, const Substep& at);

} // namespace plait
