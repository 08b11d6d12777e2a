// The parameters of a sim, as the library lists them.
#pragma once

#include <plait/plait_offline.h>

#include <vector>

namespace common {

std::vector<plait_param_info> all_params();

// Each with its default, range, unit and feature in columns, and under it what it does.
void print_params();

} // namespace common
