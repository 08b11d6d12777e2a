// Every field of plait_sim_params with its unit and range: what is checked, and what callers are
// told.
#pragma once

#include <plait/plait.h>

#include <span>

namespace plait {

// In the order of the struct.
std::span<const plait_param_info> param_table();

// "articulated"; of none, "?".
const char* model_name(plait_model model);

} // namespace plait
