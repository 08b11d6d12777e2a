// One field of plait_sim_params by its name, its components as numbers.
#pragma once

#include "base/result.hpp"

#include <plait/plait_offline.h>

#include <span>

namespace plait {

// NOT_FOUND: no field has this name.
Result<const plait_param_info*> find_param(const char* name);

// `params` with these values of `param`, checked as check_params checks them all.
Result<plait_sim_params> with_param(const plait_sim_params& params, const plait_param_info& param,
                                    std::span<const double> values);

} // namespace plait
