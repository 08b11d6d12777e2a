#include "core/params/presets.hpp"

#include "base/format.hpp"
#include "core/groom/materials.hpp"
#include "core/params/param_by_name.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <string_view>

namespace plait {
namespace {

#include "presets.inc"

bool has_value_of(const Preset& preset, std::string_view feature) {
    return std::ranges::any_of(preset.values, [&](const PresetValue& value) {
        const auto param = find_param(value.param);
        return param && feature == (*param)->feature;
    });
}

} // namespace

std::span<const Preset> presets() {
    return preset_table;
}

Result<const Preset*> find_preset(const char* name) {
    for (const Preset& preset : preset_table)
        if (std::string_view(name) == preset.name)
            return &preset;
    return Error{PLAIT_NOT_FOUND,
                 format("no preset is called \"%.64s\"; plait_presets_list names them all", name)};
}

Result<NamedParams> with_preset(const NamedParams& all, const Preset& preset) {
    const plait_sim_params defaults = default_sim_params();
    NamedParams next = all;
    next.material = default_material();
    next.params.drag = defaults.drag;
    next.params.groom = defaults.groom;
    next.params.volume = {default_volume_desc(), has_value_of(preset, "volume")};
    next.params.grid = {default_grid_desc(), has_value_of(preset, "grid") || next.params.volume.on};
    next.params.wetness = {default_wetness_desc(), has_value_of(preset, "wetness")};
    for (const PresetValue& value : preset.values) {
        const auto param = find_param(value.param);
        if (!param)
            return param.error();
        auto changed = with_param(next, **param, {value.values, value.count});
        if (!changed)
            return changed.error();
        next = *changed;
    }
    return next;
}

} // namespace plait
