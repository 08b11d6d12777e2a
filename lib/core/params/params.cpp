#include "core/params/params.hpp"

#include "core/base/pose.hpp"
#include "core/base/ranges.hpp"
#include "core/groom/materials.hpp"
#include "core/params/param_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>
#include <string_view>

namespace plait {
namespace {

// C callers can put any number into an enum, which C++ may not even look at as one.
template <typename Enum> double raw(const Enum& value) {
    int32_t number;
    static_assert(sizeof number == sizeof value);
    std::memcpy(&number, &value, sizeof number);
    return number;
}

// The message names the component.
Status check_vector(const char* field, const float (&vector)[3], double low, double high) {
    for (size_t i = 0; i < 3; ++i)
        PLAIT_TRY(check_range(format("%s[%zu]", field, i).c_str(), double(vector[i]), low, high));
    return {};
}

#define PLAIT_RANGE_OPEN(field, low, high)                                                         \
    PLAIT_TRY(check_range(#field, double(s.field), low, high, true))
#define PLAIT_RANGE_ENUM(field, high) PLAIT_TRY(check_range(#field, raw(s.field), 0, high))
#define PLAIT_RANGE_3(field, low, high) PLAIT_TRY(check_vector(#field, s.field, low, high))

// A bound is what float32 makes of it: 1e-9 itself is inside [1e-9, 1e3].
double bound(const plait_param_info& param, double value) {
    return param.kind == PLAIT_PARAM_KIND_FLOAT ? double(static_cast<float>(value)) : value;
}

// Values beside the range that leave a choice to the model.
bool left_to_model(const plait_param_info& param, double value) {
    return value == PLAIT_BDF2_OF_MODEL && std::string_view(param.name) == "bdf2";
}

// Buffers are indexed with 32 bits.
Status check_slot_total(const Params& params) {
    const double n = params.grid.edge_count;
    if (params.grid_kind() != GridKind::slots)
        return {};
    return check_range("edge_count^3 * slot_capacity", n * n * n * params.grid.slot_capacity, 1,
                       std::numeric_limits<uint32_t>::max());
}

} // namespace

plait_sim_params default_sim_params() {
    plait_sim_params p{};
    p.struct_size = sizeof p;
    p.gravity[1] = -9.81f;
    p.follow_contact = 1;
    p.follow_form = PLAIT_FOLLOW_FORM_ROTATING;
    p.drag = 2;
    p.iterations = 1;
    p.bdf2 = PLAIT_BDF2_OF_MODEL;
    return p;
}

plait_tressfx_desc default_tressfx_desc() {
    plait_tressfx_desc desc{};
    desc.struct_size = sizeof desc;
    desc.damping = 0.08f;
    desc.local_stiffness = 0.9f;
    desc.local_iterations = 2;
    desc.length_iterations = 2;
    desc.vsp_coeff = 0.8f;
    desc.vsp_accel_threshold = 1.4f;
    desc.max_displacement = 1e6f;
    desc.wind_form = PLAIT_WIND_FORM_DRAG;
    desc.wind_cone = 0.7f;
    return desc;
}

plait_grid_desc default_grid_desc() {
    plait_grid_desc desc{};
    desc.struct_size = sizeof desc;
    desc.form = PLAIT_GRID_FORM_EXACT;
    desc.edge_count = 8;
    desc.slot_capacity = 1024;
    desc.slot_hash = PLAIT_SLOT_HASH_RULE_PCG;
    desc.diffuse_rule = PLAIT_DIFFUSE_RULE_FLOORED;
    desc.diffuse_ratio = 2;
    desc.diffuse_factor = 0.9f;
    desc.diffuse_floor = 0.5f;
    return desc;
}

plait_volume_desc default_volume_desc() {
    return {sizeof(plait_volume_desc), 1, 10, 5, 5, 0};
}

plait_strand_contact_desc default_strand_contact_desc() {
    return {sizeof(plait_strand_contact_desc), 0.002f, 0.3f};
}

plait_wetness_desc default_wetness_desc() {
    return {sizeof(plait_wetness_desc), 0, 0.03f};
}

plait_acceleration_desc default_acceleration_desc() {
    return {sizeof(plait_acceleration_desc), {}};
}

Params default_params() {
    return {default_sim_params(),         default_tressfx_desc(),          {default_grid_desc()},
            {default_volume_desc()},      {default_strand_contact_desc()}, {default_wetness_desc()},
            {default_acceleration_desc()}};
}

plait_sim_desc default_sim_desc() {
    plait_sim_desc desc{};
    desc.struct_size = sizeof desc;
    desc.model = PLAIT_MODEL_ARTICULATED;
    desc.step = 1.0f / 60;
    desc.substeps = 1;
    desc.max_steps_per_call = 8;
    desc.interpolate_output = 2;
    desc.follow_radius = 0.003f;
    desc.params = default_sim_params();
    return desc;
}

Status check_component(const plait_param_info& param, uint32_t component, double value) {
    if (left_to_model(param, value))
        return {};
    const std::string name = param.count > 1 ? format("%s[%u]", param.name, component) : param.name;
    return check_range(name.c_str(), value, bound(param, param.least), bound(param, param.most),
                       param.least_excluded != 0);
}

Status check_params(const Params& params) {
    const NamedParams all{params, default_material()};
    for (const plait_param_info& param : param_table())
        for (uint32_t i = 0; i < param.count; ++i)
            PLAIT_TRY(check_component(param, i, param_component(param, all, i)));
    if (params.volume.on && params.grid.on && params.grid.form == PLAIT_GRID_FORM_SLOTS)
        return Error{PLAIT_INVALID_STATE,
                     "volume and a grid of form 0 (slots): volume needs sums of all hair, those of "
                     "a grid of form 1 (exact), or no grid of your own"};
    return check_slot_total(params);
}

Status check_reads_tressfx(plait_model model) {
    if (model == PLAIT_MODEL_TRESSFX)
        return {};
    return Error{PLAIT_INVALID_STATE,
                 "the sim is of model 1 (articulated), which reads no parameter of TressFX; a sim "
                 "of model 0 (tressfx) does"};
}

Status check_model_takes(const Params& params, plait_model model) {
    if (model == PLAIT_MODEL_ARTICULATED) {
        const plait_tressfx_desc own = default_tressfx_desc();
        return std::memcmp(&params.tressfx, &own, sizeof own) == 0 ? Status{}
                                                                   : check_reads_tressfx(model);
    }
    const auto lacks = [](const char* what) {
        return Error{PLAIT_INVALID_STATE,
                     format("the sim is of model 0 (tressfx), whose strands %s; those of "
                            "articulated do",
                            what)};
    };
    if (params.volume.on)
        return lacks("keep no volume");
    if (params.strand_contact.on)
        return lacks("do not meet each other");
    return params.wetness.on ? Status(lacks("do not get wet")) : Status{};
}

Status check_sim_desc(const plait_sim_desc& s) {
    PLAIT_RANGE_ENUM(model, PLAIT_MODEL_ARTICULATED);
    PLAIT_RANGE(step, 1e-5f, 1);
    PLAIT_RANGE(substeps, 1, 1000);
    PLAIT_RANGE(max_steps_per_call, 1, 1000);
    PLAIT_RANGE(interpolate_output, 0, 2);
    PLAIT_RANGE(keep_last_frame, 0, 1);
    const bool tressfx = s.model == PLAIT_MODEL_TRESSFX;
    PLAIT_RANGE(follows_per_guide, 0, 64);
    PLAIT_RANGE(follow_radius, 0, 1);
    PLAIT_RANGE_ENUM(sag_free, PLAIT_SAG_FREE_STIFFEN);
    if (s.sag_free != PLAIT_SAG_FREE_OFF && tressfx)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("sag_free is %d: the model tressfx has no bending that could hold a "
                            "groom's shape, articulated has",
                            s.sag_free)};
    if (s.material_count > 0 && tressfx)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("material_count is %zu: strands of the model tressfx have no material, "
                            "those of articulated do",
                            s.material_count)};
    return {};
}

plait_strand_settings default_strand_settings() {
    return {sizeof(plait_strand_settings), PLAIT_SETTING_OF_SIM, PLAIT_SETTING_OF_SIM,
            PLAIT_SETTING_OF_SIM};
}

Status check_strand_settings(const plait_strand_settings& s) {
    if (s.substeps != PLAIT_SETTING_OF_SIM)
        PLAIT_RANGE(substeps, 1, 1000);
    if (s.iterations != PLAIT_SETTING_OF_SIM)
        PLAIT_RANGE(iterations, 0, 64);
    if (s.bdf2 != PLAIT_SETTING_OF_SIM && s.bdf2 != PLAIT_BDF2_OF_MODEL)
        PLAIT_RANGE(bdf2, 0, 1);
    return {};
}

Status check_strand_stiffness(std::span<const float> scales, size_t guides) {
    if (!scales.empty() && scales.size() != guides)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("strand_stiffness.count is %zu, the groom has %zu strands",
                            scales.size(), guides)};
    for (size_t i = 0; i < scales.size(); ++i)
        PLAIT_TRY(
            check_range(format("strand_stiffness[%zu]", i).c_str(), double(scales[i]), 0, 1e6));
    return {};
}

plait_fibre default_fibre() {
    return {sizeof(plait_fibre), 1300, 35e-6f, 1, 4e9f, 1.5e9f};
}

Status set_fibre(plait_material& material, const plait_fibre& s) {
    PLAIT_RANGE(density, 1, 1e5);
    PLAIT_RANGE(radius, 1e-7f, 0.1f);
    PLAIT_RANGE(flatness, 0.05f, 1);
    PLAIT_RANGE(youngs_modulus, 0, 1e13);
    PLAIT_RANGE(shear_modulus, 0, 1e13);
    const double a = double(s.radius), f = double(s.flatness), b = a * f;
    const double quarter = std::numbers::pi / 4 * a * b;
    plait_material with = material;
    with.line_density = static_cast<float>(4 * quarter * double(s.density));
    with.bend_stiffness = static_cast<float>(quarter * b * b * double(s.youngs_modulus));
    with.section_ratio = static_cast<float>(1 / (f * f));
    // Saint-Venant's torsion constant of an ellipse
    with.twist_stiffness =
        static_cast<float>(4 * quarter * a * a * b * b / (a * a + b * b) * double(s.shear_modulus));
    PLAIT_TRY(check_material(with));
    material = with;
    return {};
}

namespace {

Status check_capsule(const plait_capsule& s) {
    PLAIT_RANGE_3(a, -1e6, 1e6);
    PLAIT_RANGE_3(b, -1e6, 1e6);
    PLAIT_RANGE_OPEN(radius_a, 0, 1e3);
    PLAIT_RANGE_OPEN(radius_b, 0, 1e3);
    return {};
}

Status check_plane(const plait_plane& s) {
    PLAIT_RANGE_3(point, -1e6, 1e6);
    PLAIT_RANGE_3(normal, -1e6, 1e6);
    const double length = std::hypot(double(s.normal[0]), double(s.normal[1]), double(s.normal[2]));
    return check_range("length of normal", length, 1e-6, 2e6);
}

Status check_box(const plait_box& s) {
    PLAIT_RANGE_3(centre, -1e6, 1e6);
    PLAIT_RANGE_3(half_extents, 0, 1e3);
    PLAIT_RANGE(rounding, 0, 1e3);
    plait_pose turned = identity_pose;
    std::copy_n(s.orientation, 4, turned.q);
    if (const auto checked = checked_pose(turned, "orientation"); !checked)
        return checked.error();
    return {};
}

// 0: as the roots.
Status check_body_scale(float scale) {
    return scale == 0 ? Status{} : check_range("scale", double(scale), 1e-3f, 1e3);
}

} // namespace

Status check_collider(const plait_collider_desc& s) {
    PLAIT_TRY(check_body_scale(s.scale));
    PLAIT_RANGE_ENUM(kind, PLAIT_COLLIDER_KIND_BOX);
    PLAIT_RANGE(friction, 0, 10);
    PLAIT_RANGE(inward, 0, 1);
    switch (s.kind) {
    case PLAIT_COLLIDER_KIND_PLANE:
        return check_plane(s.plane);
    case PLAIT_COLLIDER_KIND_BOX:
        return check_box(s.box);
    default:
        return check_capsule(s.capsule);
    }
}

Status check_hull_collider(const plait_collider_hull_desc& s) {
    PLAIT_TRY(check_body_scale(s.scale));
    PLAIT_RANGE(margin, 0, 1e3);
    PLAIT_RANGE(friction, 0, 10);
    PLAIT_RANGE(tolerance, double(1e-6f), double(0.1f)); // as float32 has them
    PLAIT_RANGE(inward, 0, 1);
    return {};
}

Status check_mesh_collider(const plait_collider_mesh_desc& s) {
    PLAIT_RANGE(cells, 8, 256);
    PLAIT_RANGE(margin, 0, 0.05);
    PLAIT_RANGE(friction, 0, 10);
    PLAIT_RANGE(clearance, 0, 1);
    PLAIT_RANGE(two_sided, 0, 1);
    PLAIT_RANGE_ENUM(form, PLAIT_MESH_FORM_NEAREST);
    return {};
}

} // namespace plait
