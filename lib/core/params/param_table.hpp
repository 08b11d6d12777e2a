// Every field of plait_sim_params with its unit, range, default and text: what is checked, and what
// callers are told.
#pragma once

#include <plait/plait_offline.h>

#include <span>

namespace plait {

// In the order of the struct.
std::span<const plait_param_info> param_table();

// One component of a field as a number.
double param_component(const plait_param_info& param, const plait_sim_params& params,
                       uint32_t component);

// "articulated"; of none, "?".
const char* model_name(plait_model model);

} // namespace plait
