// The parameters of a sim as a JSON object: every field under its own name, its range checked.
#pragma once

#include "common/json_fwd.hpp"

#include <plait/plait.hpp>

#include <array>

namespace common {

extern const std::array<const char*, 2> model_names;
extern const std::array<const char*, 3> grid_names;
extern const std::array<const char*, 3> sag_free_names;

// Fields by the names that plait_sim_set_param takes; what is absent keeps its value in `desc`. Fails
// where the model or the features of `desc` do not read what is given.
void read_params(JsonReader in, plait::SimDesc& desc);

// TressFX's alone.
void read_tressfx(JsonReader in, plait_tressfx_desc& desc);

// `grid_names`: "off" or its form.
void read_grid(JsonReader& in, plait::SimDesc& desc);
const char* grid_name(const plait::SimDesc& desc);

} // namespace common
