#include "core/params/param_table.hpp"

#include "base/format.hpp"
#include "core/params/params.hpp"
#include "core/strands/traits.hpp"

#include <cstddef>
#include <cstring>
#include <iterator>
#include <numbers>
#include <string_view>

namespace plait {
namespace {

constexpr const char* wind_forms[] = {"published", "drag"};
constexpr const char* follow_forms[] = {"published", "rotating"};
constexpr const char* shock_forms[] = {"threshold", "continuous"};
constexpr const char* orders[] = {"published", "shock_before_global"};
constexpr const char* interhairs[] = {"off", "slots", "exact"};
constexpr const char* slot_hashes[] = {"thesis", "pcg"};
constexpr const char* tents[] = {"voxel", "trilinear"};
constexpr const char* diffuse_rules[] = {"thesis", "floored"};
constexpr const char* volumes[] = {"off", "pressure"};
constexpr const char* strand_contacts[] = {"off", "on"};

// Who reads a parameter: the models of which a trait holds.
constexpr uint32_t models_that(bool ModelTraits::*has) {
    uint32_t mask = 0;
    for (const ModelTraits& row : model_table)
        mask |= row.*has ? 1u << row.model : 0u;
    return mask;
}
constexpr uint32_t tressfx = 1u << PLAIT_MODEL_TRESSFX;
constexpr uint32_t stretching = models_that(&ModelTraits::stretches);
constexpr uint32_t flat = models_that(&ModelTraits::flat);
constexpr uint32_t rods = models_that(&ModelTraits::bends);
constexpr uint32_t strand_models = models_that(&ModelTraits::switches);
constexpr uint32_t meeting = models_that(&ModelTraits::meets);
static_assert((rods & tressfx) == 0 && (strand_models & tressfx) == 0);
constexpr uint32_t every_model = tressfx | strand_models;

struct Field {
    const char* name;
    size_t offset, size;
};
#define AT(field)                                                                                  \
    Field {                                                                                        \
#field, offsetof(plait_sim_params, field), sizeof(plait_sim_params::field)                 \
    }

constexpr plait_param_info entry(plait_param_kind kind, const Field& at, const char* unit,
                                 double least, double most) {
    return {sizeof(plait_param_info),
            kind,
            at.name,
            unit,
            nullptr,
            static_cast<uint32_t>(at.offset),
            static_cast<uint32_t>(at.size / 4),
            least,
            most,
            0,
            every_model};
}
constexpr plait_param_info real(const Field& at, const char* unit, double least, double most) {
    return entry(PLAIT_PARAM_KIND_FLOAT, at, unit, least, most);
}
constexpr plait_param_info above(const Field& at, const char* unit, double least, double most) {
    plait_param_info info = real(at, unit, least, most);
    info.least_excluded = 1;
    return info;
}
constexpr plait_param_info whole(const Field& at, double least, double most) {
    return entry(PLAIT_PARAM_KIND_UINT, at, "", least, most);
}
template <size_t N>
constexpr plait_param_info choice(const Field& at, const char* const (&names)[N]) {
    plait_param_info info = entry(PLAIT_PARAM_KIND_CHOICE, at, "", 0, N - 1);
    info.choices = names;
    return info;
}

constexpr plait_param_info of(uint32_t readers, plait_param_info info) {
    info.models = readers;
    return info;
}

constexpr plait_param_info table[] = {
    real(AT(gravity), "m/s^2", -1e4, 1e4),

    of(tressfx, real(AT(damping), "", 0, 100)),
    of(tressfx, real(AT(local_stiffness), "", 0, 1)),
    of(tressfx, whole(AT(local_iterations), 0, 64)),
    of(tressfx, real(AT(global_stiffness), "", 0, 1)),
    of(tressfx, real(AT(global_range), "", 0, 1)),
    of(tressfx, whole(AT(length_iterations), 0, 256)),
    of(tressfx, real(AT(vsp_coeff), "", 0, 1)),
    of(tressfx, real(AT(vsp_accel_threshold), "m", 0, 1e6)),
    of(tressfx, above(AT(max_displacement), "m", 0, 1e6)),
    of(tressfx, real(AT(attachment), "", 0, 100)),
    real(AT(tip_separation), "", 0, 100),
    of(tressfx, choice(AT(wind_form), wind_forms)),
    choice(AT(follow_form), follow_forms),
    of(tressfx, choice(AT(shock_form), shock_forms)),
    of(tressfx, choice(AT(order), orders)),

    of(strand_models, whole(AT(iterations), 0, 64)),
    of(strand_models, whole(AT(bdf2), 0, 1)),
    of(rods, real(AT(line_density), "kg/m", 1e-9, 1e3)),
    of(rods, real(AT(bend_stiffness), "N m^2", 0, 1e3)),
    of(stretching, real(AT(stretch_stiffness), "N", 0, 1e9)),
    of(rods, real(AT(twist_stiffness), "N m^2", 0, 1e3)),
    of(flat, real(AT(section_ratio), "", 1e-3, 1e3)),
    of(rods, real(AT(tip_stiffness), "", 0, 100)),
    of(strand_models, real(AT(tip_density), "", 1e-3, 1e3)),
    of(strand_models, real(AT(drag), "1/s", 0, 1e4)),

    of(strand_models, real(AT(groom), "", 0, 1)),

    real(AT(wind), "m/s", -1e3, 1e3),
    of(strand_models, real(AT(air_with_head), "", 0, 1)),
    of(tressfx, real(AT(air_drag), "1/m", 0, 1e6)),
    of(tressfx, real(AT(wind_cone), "rad", 0, std::numbers::pi / 2)),

    choice(AT(interhair), interhairs),
    whole(AT(grid_edge_count), 1, 64),
    whole(AT(slot_capacity), 1, 65536),
    choice(AT(slot_hash), slot_hashes),
    choice(AT(tent), tents),
    choice(AT(diffuse_rule), diffuse_rules),
    real(AT(diffuse_ratio), "", 0, 1e6),
    real(AT(diffuse_factor), "", 0, 1),
    real(AT(diffuse_floor), "", 0, 1),
    whole(AT(grid_in_world), 0, 1),
    real(AT(grid_origin), "m", -1e6, 1e6),
    real(AT(grid_edge), "m", 0, 1e6),

    of(strand_models, choice(AT(volume), volumes)),
    of(strand_models, real(AT(volume_share), "", 0, 4)),
    of(strand_models, whole(AT(volume_sweeps), 1, 64)),
    of(strand_models, real(AT(volume_rate), "1/s", 0, 1e3)),
    of(strand_models, real(AT(volume_viscosity), "1/s", 0, 1e3)),
    of(strand_models, real(AT(cohesion), "m^2/s^2", 0, 1e4)),

    of(strand_models, real(AT(drying_time), "s", 0, 1e9)),
    of(strand_models, real(AT(wet_cohesion), "m^2/s^2", 0, 1e4)),

    of(meeting, choice(AT(strand_contact), strand_contacts)),
    of(meeting, above(AT(strand_radius), "m", 0, 0.1)),
    of(meeting, real(AT(strand_friction), "", 0, 10)),

    whole(AT(follow_contact), 0, 1),

    real(AT(accelerate_values), "", -1e6, 1e6),
};

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
    for (const ModelTraits& row : model_table)
        if (mask & (1u << row.model))
            text += (text.empty() ? "" : ", ") + std::string(row.name);
    return text;
}

bool same(const plait_param_info& param, const plait_sim_params& a, const plait_sim_params& b) {
    const auto at = [&](const plait_sim_params& params) {
        return reinterpret_cast<const unsigned char*>(&params) + param.offset;
    };
    return std::memcmp(at(a), at(b), size_t{4} * param.count) == 0;
}

} // namespace

std::span<const plait_param_info> param_table() {
    return table;
}

const char* model_name(plait_model model) {
    const auto number = static_cast<uint32_t>(model);
    return number < std::size(model_table) ? model_table[number].name : "?";
}

std::string ignored_warning(const plait_param_info& param, const plait_sim_params& before,
                            const plait_sim_params& now, const Readers& readers) {
    const uint32_t used = readers.models;
    if (same(param, now, before) || same(param, now, default_params()))
        return {};
    if (param.offset == offsetof(plait_sim_params, accelerate_values) && *readers.no_accelerate)
        return format("params: %s is set, and no kernel reads it: %s", param.name,
                      readers.no_accelerate);
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
