// Ranges of what the caller may set.
#pragma once

#include "base/result.hpp"

#include <plait/plait_offline.h>

#include <span>

namespace plait {

plait_sim_params default_params();
plait_sim_desc default_sim_desc();

// INVALID_ARGUMENT names the field, its value and its range.
Status check_component(const plait_param_info& param, uint32_t component, double value);
Status check_params(const plait_sim_params& params);
Status check_sim_desc(const plait_sim_desc& desc);
Status check_volume(const plait_sim_params& params, plait_model model); // whether it has one
Status check_strand_contact(const plait_sim_params& params, plait_model model); // the same
plait_strand_settings default_strand_settings();
Status check_strand_settings(const plait_strand_settings& settings);
Status check_strand_stiffness(std::span<const float> scales, size_t guides);
plait_fibre default_fibre();
Status set_fibre(plait_sim_params& params, const plait_fibre& fibre);
Status check_hull_collider(const plait_collider_hull_desc& desc);
Status check_mesh_collider(const plait_collider_mesh_desc& s);
Status check_collider(const plait_collider_desc& desc);

} // namespace plait
