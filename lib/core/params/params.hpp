// Ranges of what the caller may set.
#pragma once

#include "base/result.hpp"
#include "core/base/params.hpp"

#include <plait/plait_offline.h>

#include <span>

namespace plait {

plait_sim_params default_sim_params();
plait_tressfx_desc default_tressfx_desc();
plait_grid_desc default_grid_desc();
plait_volume_desc default_volume_desc();
plait_strand_contact_desc default_strand_contact_desc();
plait_wetness_desc default_wetness_desc();
plait_acceleration_desc default_acceleration_desc();
Params default_params();
plait_sim_desc default_sim_desc();

// INVALID_ARGUMENT names the field, its value and its range.
Status check_component(const plait_param_info& param, uint32_t component, double value);
// Also INVALID_STATE: features that do not go together.
Status check_params(const Params& params);
// INVALID_STATE: the model is not TressFX.
Status check_reads_tressfx(plait_model model);
// INVALID_STATE: features that the model has not.
Status check_model_takes(const Params& params, plait_model model);
Status check_sim_desc(const plait_sim_desc& desc); // but for its params
plait_strand_settings default_strand_settings();
Status check_strand_settings(const plait_strand_settings& settings);
Status check_strand_stiffness(std::span<const float> scales, size_t guides);
plait_fibre default_fibre();
Status set_fibre(plait_material& material, const plait_fibre& fibre);
Status check_hull_collider(const plait_collider_hull_desc& desc);
Status check_mesh_collider(const plait_collider_mesh_desc& s);
Status check_collider(const plait_collider_desc& desc);

} // namespace plait
