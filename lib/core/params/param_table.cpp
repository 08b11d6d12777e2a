#include "core/params/param_table.hpp"

#include <cstddef>
#include <iterator>
#include <numbers>

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

// In the order of plait_model.
constexpr const char* model_names[] = {"tressfx", "articulated"};

// Who reads a parameter.
constexpr uint32_t tressfx = 1u << PLAIT_MODEL_TRESSFX, articulated = 1u << PLAIT_MODEL_ARTICULATED;
constexpr uint32_t every_model = tressfx | articulated;

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

    of(articulated, whole(AT(iterations), 0, 64)),
    of(articulated, whole(AT(bdf2), 0, 1)),
    of(articulated, real(AT(line_density), "kg/m", 1e-9, 1e3)),
    of(articulated, real(AT(bend_stiffness), "N m^2", 0, 1e3)),
    of(0, real(AT(stretch_stiffness), "N", 0, 1e9)), // kernels of the caller's may
    of(articulated, real(AT(twist_stiffness), "N m^2", 0, 1e3)),
    of(articulated, real(AT(section_ratio), "", 1e-3, 1e3)),
    of(articulated, real(AT(tip_stiffness), "", 0, 100)),
    of(articulated, real(AT(tip_density), "", 1e-3, 1e3)),
    of(articulated, real(AT(drag), "1/s", 0, 1e4)),

    of(articulated, real(AT(groom), "", 0, 1)),

    real(AT(wind), "m/s", -1e3, 1e3),
    of(articulated, real(AT(air_with_head), "", 0, 1)),
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

    of(articulated, choice(AT(volume), volumes)),
    of(articulated, real(AT(volume_share), "", 0, 4)),
    of(articulated, whole(AT(volume_sweeps), 1, 64)),
    of(articulated, real(AT(volume_rate), "1/s", 0, 1e3)),
    of(articulated, real(AT(volume_viscosity), "1/s", 0, 1e3)),
    of(articulated, real(AT(cohesion), "m^2/s^2", 0, 1e4)),

    of(articulated, real(AT(drying_time), "s", 0, 1e9)),
    of(articulated, real(AT(wet_cohesion), "m^2/s^2", 0, 1e4)),

    of(articulated, choice(AT(strand_contact), strand_contacts)),
    of(articulated, above(AT(strand_radius), "m", 0, 0.1)),
    of(articulated, real(AT(strand_friction), "", 0, 10)),

    whole(AT(follow_contact), 0, 1),

    real(AT(accelerate_values), "", -1e6, 1e6),
};

} // namespace

std::span<const plait_param_info> param_table() {
    return table;
}

const char* model_name(plait_model model) {
    const auto number = static_cast<uint32_t>(model);
    return number < std::size(model_names) ? model_names[number] : "?";
}

} // namespace plait
