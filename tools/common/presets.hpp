// Kinds of hair by name, as the library has them.
#pragma once

#include "common/json_fwd.hpp"

#include <plait/plait.hpp>

#include <string>
#include <vector>

namespace common {

std::vector<plait_preset_info> all_presets();

// Puts the values of a preset into `desc`, and turns on the features that they belong to: of the one that
// the key "preset" names, or else of `otherwise`. Returns its name; "": of none.
std::string read_preset(JsonReader& in, const std::string& otherwise, plait::SimDesc& desc);

// Each with its sentence.
void print_presets();

} // namespace common
