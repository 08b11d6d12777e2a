#include "core/params/param_warnings.hpp"

#include "base/format.hpp"
#include "core/params/param_table.hpp"
#include "core/params/params.hpp"

#include <cstddef>
#include <cstring>

namespace plait {
namespace {

// What a parameter does nothing without, and how to have it.
struct Needs {
    size_t offset;
    bool (*has)(const plait_sim_params&, const OpenFeatures&);
    const char* feature;
};

bool has_grid(const plait_sim_params& p, const OpenFeatures&) {
    return p.interhair != PLAIT_INTERHAIR_OFF;
}
bool has_brake(const plait_sim_params& p, const OpenFeatures&) {
    return p.interhair != PLAIT_INTERHAIR_OFF && p.volume == PLAIT_VOLUME_OFF;
}
bool has_slots(const plait_sim_params& p, const OpenFeatures&) {
    return p.interhair == PLAIT_INTERHAIR_SLOTS;
}
bool has_volume(const plait_sim_params& p, const OpenFeatures&) {
    return p.volume != PLAIT_VOLUME_OFF;
}
bool has_meeting(const plait_sim_params& p, const OpenFeatures&) {
    return p.strand_contact != PLAIT_STRAND_CONTACT_OFF;
}
bool is_wet(const plait_sim_params&, const OpenFeatures& open) {
    return open.wet;
}
bool has_copies(const plait_sim_params&, const OpenFeatures& open) {
    return open.follow_copies;
}
bool is_wet_with_volume(const plait_sim_params& p, const OpenFeatures& open) {
    return open.wet && has_volume(p, open);
}

constexpr const char* no_grid = "without the grid between strands (interhair)";
constexpr const char* no_brake = "without the grid's brake (interhair, and volume off)";
constexpr const char* no_slots = "but with interhair 1 (slots)";
constexpr const char* no_volume = "without volume (volume, interhair 2)";
constexpr const char* no_meeting = "while strands do not meet (strand_contact)";
constexpr const char* dry = "while all hair is dry (PLAIT_FIELD_WETNESS)";
constexpr const char* no_copies = "without follows_per_guide";

#define NEEDS(field, has, feature)                                                                 \
    { offsetof(plait_sim_params, field), has, feature }
constexpr Needs needs_table[] = {
    NEEDS(tip_separation, has_copies, no_copies),
    NEEDS(follow_form, has_copies, no_copies),
    NEEDS(slot_capacity, has_slots, no_slots),
    NEEDS(slot_hash, has_slots, no_slots),
    NEEDS(tent, has_grid, no_grid),
    NEEDS(diffuse_rule, has_brake, no_brake),
    NEEDS(diffuse_ratio, has_brake, no_brake),
    NEEDS(diffuse_factor, has_brake, no_brake),
    NEEDS(diffuse_floor, has_brake, no_brake),
    NEEDS(grid_edge_count, has_grid, no_grid),
    NEEDS(grid_in_world, has_grid, no_grid),
    NEEDS(grid_origin, has_grid, no_grid),
    NEEDS(grid_edge, has_grid, no_grid),
    NEEDS(volume_share, has_volume, no_volume),
    NEEDS(volume_sweeps, has_volume, no_volume),
    NEEDS(volume_rate, has_volume, no_volume),
    NEEDS(volume_viscosity, has_volume, no_volume),
    NEEDS(cohesion, has_volume, no_volume),
    NEEDS(drying_time, is_wet, dry),
    NEEDS(wet_cohesion, is_wet_with_volume, "without wet hair that has volume"),
    NEEDS(strand_radius, has_meeting, no_meeting),
    NEEDS(strand_friction, has_meeting, no_meeting),
};
#undef NEEDS

std::string names(uint32_t mask) {
    std::string text;
    for (uint32_t model = 0; mask >> model != 0; ++model)
        if (mask & (1u << model))
            text += (text.empty() ? "" : ", ") +
                    std::string(model_name(static_cast<plait_model>(model)));
    return text;
}

bool same(const plait_param_info& param, const plait_sim_params& a, const plait_sim_params& b) {
    const auto at = [&](const plait_sim_params& params) {
        return reinterpret_cast<const unsigned char*>(&params) + param.offset;
    };
    return std::memcmp(at(a), at(b), size_t{4} * param.count) == 0;
}

} // namespace

std::string ignored_warning(const plait_param_info& param, const plait_sim_params& before,
                            const plait_sim_params& now, const Readers& readers) {
    const uint32_t used = readers.models;
    if (same(param, now, before) || same(param, now, default_params()))
        return {};
    if (param.offset == offsetof(plait_sim_params, accelerate_values) && *readers.no_accelerate)
        return format("params: %s is set, and no kernel reads it: %s", param.name,
                      readers.no_accelerate);
    if (param.models == 0)
        return format("params: %s is set, and no model of the library reads it", param.name);
    if ((param.models & used) == 0)
        return format("params: %s is set, and no strand's model (%s) reads it; those that do: %s",
                      param.name, names(used).c_str(), names(param.models).c_str());
    return {};
}

std::string off_warning(const plait_param_info& param, const plait_sim_params& before,
                        const plait_sim_params& now, const OpenFeatures& open) {
    if (same(param, now, before) || same(param, now, default_params()))
        return {};
    for (const Needs& needs : needs_table)
        if (needs.offset == param.offset && !needs.has(now, open))
            return format("params: %s is set, and does nothing %s", param.name, needs.feature);
    return {};
}

} // namespace plait
