#include "common/presets.hpp"

#include "common/failure.hpp"
#include "common/json_reader.hpp"
#include "common/params_list.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace common {

namespace {

std::vector<plait_preset_value> values_of(const std::string& preset) {
    size_t count = 0;
    check(plait_preset_read(preset.c_str(), nullptr, &count));
    std::vector<plait_preset_value> values(count, plait_preset_value_defaults());
    check(plait_preset_read(preset.c_str(), values.data(), &count));
    return values;
}

void put(plait::SimDesc& desc, const plait_preset_value& value) {
    const auto& all = all_params();
    const auto info = std::ranges::find_if(all, [&](const plait_param_info& each) {
        return std::string_view(each.name) == value.param;
    });
    const std::string_view feature = info->feature;
    desc.grid.on |= feature == "grid" || feature == "volume";
    desc.volume.on |= feature == "volume";
    desc.wetness.on |= feature == "wetness";
    auto* const at = static_cast<unsigned char*>(plait::field_of(desc, *info));
    for (uint32_t i = 0; i < value.count; ++i) {
        const auto number = static_cast<float>(value.values[i]);
        const auto whole = static_cast<uint32_t>(value.values[i]);
        if (info->kind == PLAIT_PARAM_KIND_FLOAT)
            std::memcpy(at + 4 * i, &number, sizeof number);
        else
            std::memcpy(at + 4 * i, &whole, sizeof whole);
    }
}

} // namespace

std::vector<plait_preset_info> all_presets() {
    size_t count = 0;
    check(plait_presets_list(nullptr, &count));
    std::vector<plait_preset_info> infos(count, plait_preset_info_defaults());
    check(plait_presets_list(infos.data(), &count));
    return infos;
}

std::string read_preset(JsonReader& in, const std::string& otherwise, plait::SimDesc& desc) {
    std::string name = otherwise;
    const bool given = in.text("preset", name);
    if (name.empty())
        return name;
    const std::vector<plait_preset_info> all = all_presets();
    if (std::ranges::none_of(all,
                             [&](const plait_preset_info& info) { return name == info.name; })) {
        std::string names;
        for (const plait_preset_info& info : all)
            names += (names.empty() ? "" : ", ") + std::string(info.name);
        in.fail("preset", "is \"" + name + "\", not one of " + names);
    }
    if (given && desc.model == PLAIT_MODEL_TRESSFX)
        in.fail("preset", "is given, and presets are of the model articulated");
    for (const plait_preset_value& value : values_of(name))
        put(desc, value);
    return name;
}

void print_presets() {
    for (const plait_preset_info& info : all_presets())
        std::printf("%-16s %s\n", info.name, info.text);
}

} // namespace common
