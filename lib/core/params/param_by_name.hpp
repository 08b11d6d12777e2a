// Single fields by their names.
#pragma once

#include "base/result.hpp"
#include "core/params/param_table.hpp"

#include <span>

namespace plait {

// NOT_FOUND.
Result<const plait_param_info*> find_param(const char* name);

// `all` with the components of one field changed, and its ranges checked. INVALID_STATE: the feature
// that it belongs to is off.
Result<NamedParams> with_param(const NamedParams& all, const plait_param_info& param,
                               std::span<const double> values);

} // namespace plait
