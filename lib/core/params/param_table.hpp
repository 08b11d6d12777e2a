// Every field that has a name, with its unit, range, default and text: what is checked, and what
// callers are told.
#pragma once

#include "core/base/params.hpp"

#include <plait/plait_offline.h>

#include <span>

namespace plait {

// All that fields lie in.
struct NamedParams {
    Params params;
    plait_material material; // of all strands
};

// Struct by struct, in the order of its fields.
std::span<const plait_param_info> param_table();

// The first component of a field: float, uint32_t or an enum.
const unsigned char* param_at(const plait_param_info& param, const NamedParams& all);
unsigned char* param_at(const plait_param_info& param, NamedParams& all);
// One component as a number.
double param_component(const plait_param_info& param, const NamedParams& all, uint32_t component);

// Whether the sim has the feature that the field belongs to.
bool feature_is_on(const plait_param_info& param, const Params& params);

// "articulated"; of none, "?".
const char* model_name(plait_model model);

} // namespace plait
