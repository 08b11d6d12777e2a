#include "core/params/param_warnings.hpp"

#include "base/format.hpp"
#include "core/groom/materials.hpp"
#include "core/params/params.hpp"

#include <cstring>
#include <string_view>

namespace plait {
namespace {

bool same(const plait_param_info& param, const NamedParams& a, const NamedParams& b) {
    return std::memcmp(param_at(param, a), param_at(param, b), size_t{4} * param.count) == 0;
}

// What a parameter does nothing without, beside its feature.
struct Needs {
    const char* name;
    bool (*has)(const Params&, const Readers&);
    const char* what;
};

bool has_slots(const Params& p, const Readers&) {
    return p.grid_kind() == GridKind::slots;
}
bool has_brake(const Params& p, const Readers&) {
    return !p.volume.on;
}
bool has_volume(const Params& p, const Readers&) {
    return p.volume.on;
}
bool has_copies(const Params&, const Readers& readers) {
    return readers.follow_copies;
}

constexpr const char* no_slots = "by a grid of form 1 (exact)";
constexpr const char* no_brake = "while volume takes the place of the grid's brake";
constexpr const char* no_copies = "without follows_per_guide";

constexpr Needs needs_table[] = {
    {"tip_separation", has_copies, no_copies},          {"follow_form", has_copies, no_copies},
    {"grid_slot_capacity", has_slots, no_slots},        {"grid_slot_hash", has_slots, no_slots},
    {"grid_diffuse_rule", has_brake, no_brake},         {"grid_diffuse_ratio", has_brake, no_brake},
    {"grid_diffuse_factor", has_brake, no_brake},       {"grid_diffuse_floor", has_brake, no_brake},
    {"wetness_cohesion", has_volume, "without volume"},
};

} // namespace

std::string ignored_warning(const plait_param_info& param, const NamedParams& before,
                            const NamedParams& now, const Readers& readers) {
    if (same(param, now, before) || same(param, now, {default_params(), default_material()}))
        return {};
    const std::string_view name = param.name;
    if (name == "acceleration_values" && *readers.no_accelerate)
        return format("params: %s is set, and no kernel reads it: %s", param.name,
                      readers.no_accelerate);
    if (param.models == 0)
        return format("params: %s is set, and no model of the library reads it", param.name);
    if ((param.models & (1u << readers.model)) == 0)
        return format("params: %s is set, and strands of the model %s do not read it", param.name,
                      model_name(readers.model));
    for (const Needs& needs : needs_table)
        if (name == needs.name && !needs.has(now.params, readers))
            return format("params: %s is set, and is not read %s", param.name, needs.what);
    return {};
}

} // namespace plait
