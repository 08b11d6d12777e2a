// Kinds of hair by name: the values of parameters that make hair straight, curly or a fur.
#pragma once

#include "base/result.hpp"
#include "core/params/param_table.hpp"

#include <span>

namespace plait {

struct PresetValue {
    const char* param; // as plait_sim_set_param takes it
    double values[4];
    uint32_t count;
};

// assets/presets has one file for each.
struct Preset {
    const char *name, *text, *groom;
    std::span<const PresetValue> values;
};

// By name.
std::span<const Preset> presets();

// NOT_FOUND.
Result<const Preset*> find_preset(const char* name);

// `all` as the preset has it: a feature is on if the preset has a value of it. The material, and those of
// params that are hair's own, are at their defaults where it has none; the others stay.
Result<NamedParams> with_preset(const NamedParams& all, const Preset& preset);

} // namespace plait
