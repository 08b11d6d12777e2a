#include "core/param_table.hpp"

#include <cstddef>
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

struct Place {
    const char* name;
    size_t offset, size;
};
#define AT(field)                                                                                  \
    Place {                                                                                        \
#field, offsetof(plait_sim_params, field), sizeof(plait_sim_params::field)                 \
    }

constexpr plait_param_info entry(plait_param_kind kind, const Place& at, const char* unit,
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
            0};
}
constexpr plait_param_info real(const Place& at, const char* unit, double least, double most) {
    return entry(PLAIT_PARAM_FLOAT, at, unit, least, most);
}
constexpr plait_param_info above(const Place& at, const char* unit, double least, double most) {
    plait_param_info info = real(at, unit, least, most);
    info.least_excluded = 1;
    return info;
}
constexpr plait_param_info whole(const Place& at, double least, double most) {
    return entry(PLAIT_PARAM_UINT, at, "", least, most);
}
template <size_t N>
constexpr plait_param_info choice(const Place& at, const char* const (&names)[N]) {
    plait_param_info info = entry(PLAIT_PARAM_CHOICE, at, "", 0, N - 1);
    info.choices = names;
    return info;
}

constexpr plait_param_info table[] = {
    real(AT(gravity), "m/s^2", -1e4, 1e4),

    real(AT(damping), "", 0, 100),
    real(AT(local_stiffness), "", 0, 1),
    whole(AT(local_iterations), 0, 64),
    real(AT(global_stiffness), "", 0, 1),
    real(AT(global_range), "", 0, 1),
    whole(AT(length_iterations), 0, 256),
    real(AT(vsp_coeff), "", 0, 1),
    real(AT(vsp_accel_threshold), "m", 0, 1e6),
    above(AT(max_displacement), "m", 0, 1e6),
    real(AT(tip_separation), "", 0, 100),
    choice(AT(wind_form), wind_forms),
    choice(AT(follow_form), follow_forms),
    choice(AT(shock_form), shock_forms),
    choice(AT(order), orders),

    whole(AT(iterations), 0, 64),
    whole(AT(bdf2), 0, 1),
    real(AT(line_density), "kg/m", 1e-9, 1e3),
    real(AT(bend_stiffness), "N m^2", 0, 1e3),
    real(AT(stretch_stiffness), "N", 0, 1e9),
    real(AT(twist_stiffness), "N m^2", 0, 1e3),
    real(AT(section_ratio), "", 1e-3, 1e3),
    real(AT(tip_stiffness), "", 0, 100),
    real(AT(tip_density), "", 1e-3, 1e3),
    real(AT(drag), "1/s", 0, 1e4),

    whole(AT(shape_constraints), 0, 1),
    real(AT(attachment), "", 0, 100),

    real(AT(wind), "m/s", -1e3, 1e3),
    real(AT(air_with_head), "", 0, 1),
    real(AT(air_drag), "1/m", 0, 1e6),
    real(AT(wind_cone), "rad", 0, std::numbers::pi / 2),

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
};

} // namespace

std::span<const plait_param_info> param_table() {
    return table;
}

} // namespace plait
