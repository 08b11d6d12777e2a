// plait_sim_params as a JSON object: every field under its own name, its range checked.
#pragma once

#include "common/json_reader.hpp"

#include <plait/plait.h>

#include <array>

namespace common {

extern const std::array<const char*, 2> model_names;
extern const std::array<const char*, 3> interhair_names;
extern const std::array<const char*, 3> sag_free_names;

// What is absent keeps its value in `params`.
void read_params(JsonReader in, plait_sim_params& params);

// Those that the model tressfx alone reads.
void take_tressfx(const plait_sim_params& from, plait_sim_params& to);

} // namespace common
