#include "core/params/param_table.hpp"

#include "core/params/params.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
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

// Values that suit real hair.
struct Slider {
    double least, most;
    uint32_t logarithmic = 0;
};
constexpr Slider linear(double least, double most) {
    return {least, most};
}
constexpr Slider logarithmic(double least, double most) {
    return {least, most, 1};
}

constexpr plait_param_info entry(plait_param_kind kind, const Field& at, const char* unit,
                                 double least, double most) {
    plait_param_info info{};
    info.struct_size = sizeof info;
    info.kind = kind;
    info.name = at.name;
    info.unit = unit;
    info.offset = static_cast<uint32_t>(at.offset);
    info.count = static_cast<uint32_t>(at.size / 4);
    info.least = info.slider_least = least;
    info.most = info.slider_most = most;
    info.models = every_model;
    return info;
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

// The slider of a field that is given none is as long as its range.
constexpr plait_param_info says(const char* feature, plait_param_info info, const char* text) {
    info.feature = feature;
    info.text = text;
    return info;
}
constexpr plait_param_info says(const char* feature, plait_param_info info, const Slider& slider,
                                const char* text) {
    info.slider_least = slider.least;
    info.slider_most = slider.most;
    info.slider_log = slider.logarithmic;
    return says(feature, info, text);
}

constexpr plait_param_info fields[] = {
    says("gravity", real(AT(gravity), "m/s^2", -1e4, 1e4), linear(-20, 20),
         "Gravity pulls all hair with this acceleration."),

    says("tressfx", of(tressfx, real(AT(damping), "", 0, 100)), linear(0, 1),
         "A larger value slows hair down sooner, against the world and not against the head."),
    says("tressfx", of(tressfx, real(AT(local_stiffness), "", 0, 1)),
         "A larger value draws each segment more strongly to its groomed direction from the one "
         "before."),
    says("tressfx", of(tressfx, whole(AT(local_iterations), 0, 64)), linear(0, 16),
         "More iterations make hair stiffer, and each of them costs time."),
    says("tressfx", of(tressfx, real(AT(global_stiffness), "", 0, 1)),
         "A larger value draws the part of a strand near its root more strongly to where it was "
         "groomed."),
    says("tressfx", of(tressfx, real(AT(global_range), "", 0, 1)),
         "This share of each strand, from the root on, feels global_stiffness."),
    says("tressfx", of(tressfx, whole(AT(length_iterations), 0, 256)), linear(0, 64),
         "More iterations leave hair less stretched, and each of them costs time."),
    says("tressfx", of(tressfx, real(AT(vsp_coeff), "", 0, 1)),
         "A larger value carries hair along with the motion of its root more closely."),
    says("tressfx", of(tressfx, real(AT(vsp_accel_threshold), "m", 0, 1e6)), linear(0, 5),
         "Hair takes on all of its root's motion when that changes by more than this from one step "
         "to the next."),
    says("tressfx", of(tressfx, above(AT(max_displacement), "m", 0, 1e6)), logarithmic(1e-3, 1),
         "No vertex moves farther than this in a substep, and the default switches the limit off."),
    says("tressfx", of(tressfx, real(AT(attachment), "", 0, 100)), linear(0, 2),
         "No vertex gets farther from its root than this times the length of hair between them, "
         "and 0 sets no limit."),
    says("follows", real(AT(tip_separation), "", 0, 100), linear(0, 2),
         "A larger value spreads the tips of follows farther from their guide."),
    says("tressfx", of(tressfx, choice(AT(wind_form), wind_forms)),
         "The form drag blows hair with the wind in SI units, and published blows it as TressFX "
         "does."),
    says("follows", choice(AT(follow_form), follow_forms),
         "The form rotating turns follows with their guide, and published only moves them along."),
    says("tressfx", of(tressfx, choice(AT(shock_form), shock_forms)),
         "The form threshold lets hair take on its root's motion with a jump, and continuous "
         "without one."),
    says("tressfx", of(tressfx, choice(AT(order), orders)),
         "The order shock_before_global keeps hair together after a jump of the head, which "
         "published does not."),

    says("solver", of(articulated, whole(AT(iterations), 0, 64)), linear(1, 8),
         "More Newton steps solve the motion of stiff or fast hair more exactly, and each costs "
         "time."),
    says("solver", of(articulated, whole(AT(bdf2), 0, 1)),
         "The value 1 damps a swing little, 0 damps it more, and the default is 1 unless "
         "strand_contact is on."),
    says("material", of(articulated, real(AT(line_density), "kg/m", 1e-9, 1e3)),
         logarithmic(1e-6, 1e-3),
         "A larger value makes hair heavier, so that it sags more under its weight."),
    says("material", of(articulated, real(AT(bend_stiffness), "N m^2", 0, 1e3)),
         logarithmic(1e-10, 1e-5),
         "A larger value makes hair harder to bend, so that it sags less and springs back faster."),
    // Kernels of the caller's may read it.
    says("material", of(0, real(AT(stretch_stiffness), "N", 0, 1e9)), logarithmic(1e-2, 1e2),
         "A larger value makes hair of the caller's kernels harder to stretch, and 0 lets the "
         "library choose."),
    says("material", of(articulated, real(AT(twist_stiffness), "N m^2", 0, 1e3)),
         logarithmic(1e-10, 1e-5),
         "A larger value makes hair harder to twist, so that curls hang out less, and 0 takes "
         "bend_stiffness."),
    says("material", of(articulated, real(AT(section_ratio), "", 1e-3, 1e3)), logarithmic(0.1, 10),
         "A value other than 1 makes hair flat, so that it bends more easily about one axis than "
         "the other."),
    says("material", of(articulated, real(AT(tip_stiffness), "", 0, 100)), linear(0, 2),
         "A value below 1 makes hair softer towards its tip, and one above 1 makes it stiffer."),
    says("material", of(articulated, real(AT(tip_density), "", 1e-3, 1e3)), linear(0.1, 2),
         "A value below 1 makes hair lighter towards its tip, and one above 1 makes it heavier."),
    says("wind", of(articulated, real(AT(drag), "1/s", 0, 1e4)), linear(0, 20),
         "A larger value makes the air brake hair more, so that it stops swinging sooner."),

    says("groom", of(articulated, real(AT(groom), "", 0, 1)),
         "A larger value keeps hair closer to its groomed shape, and at 1 it stays in that shape."),

    says("wind", real(AT(wind), "m/s", -1e3, 1e3), linear(-30, 30),
         "The air moves with this velocity, and drag says how fast it takes hair along."),
    says("wind", of(articulated, real(AT(air_with_head), "", 0, 1)),
         "The air takes on this share of the head's velocity, so that a moving head's hair lags "
         "behind less."),
    says("tressfx", of(tressfx, real(AT(air_drag), "1/m", 0, 1e6)), linear(0, 20),
         "A larger value makes the wind push hair more, and still air brake it more."),
    says("tressfx", of(tressfx, real(AT(wind_cone), "rad", 0, std::numbers::pi / 2)),
         "The published form of the wind spreads its directions over a cone of this half angle."),

    says("grid", choice(AT(interhair), interhairs),
         "The choice exact or slots slows hair that outruns the hair around it, and off leaves "
         "strands alone."),
    says("grid", whole(AT(grid_edge_count), 1, 64), linear(4, 64),
         "More voxels along each edge compare hair with nearer hair only."),
    says("grid", whole(AT(slot_capacity), 1, 65536), logarithmic(64, 16384),
         "More slots in a voxel sample more of its hair, and take more memory."),
    says("grid", choice(AT(slot_hash), slot_hashes),
         "The rule pcg samples the hair in a voxel evenly, and thesis samples it as published."),
    says("grid", choice(AT(tent), tents),
         "The form trilinear slows hair smoothly across voxels, and voxel with a jump at their "
         "borders."),
    says("grid", choice(AT(diffuse_rule), diffuse_rules),
         "The rule thesis slows all hair where hair swings to and fro, and floored only the "
         "fastest of it."),
    says("grid", real(AT(diffuse_ratio), "", 0, 1e6), linear(0, 5),
         "A smaller value slows more hair: all that is faster than this times the hair around it."),
    says("grid", real(AT(diffuse_factor), "", 0, 1),
         "A smaller value slows hair that is too fast more: it keeps this share of its velocity in "
         "a step."),
    says("grid", real(AT(diffuse_floor), "", 0, 1),
         "A larger value leaves more hair alone where the hair around it swings to and fro."),
    says("grid", whole(AT(grid_in_world), 0, 1),
         "The value 0 lets the grid go with the head, and 1 fixes it in the world."),
    says("grid", real(AT(grid_origin), "m", -1e6, 1e6), linear(-2, 2),
         "The grid has its corner here if grid_edge is above 0, and hair outside of it is not "
         "slowed."),
    says("grid", real(AT(grid_edge), "m", 0, 1e6), linear(0, 2),
         "The grid is a cube with edges of this length, and 0 fits it around the groom."),

    says("volume", of(articulated, choice(AT(volume), volumes)),
         "The choice pressure keeps the room that hair has in the groom, by interhair exact, and "
         "off lets it sink together."),
    says("volume", of(articulated, real(AT(volume_share), "", 0, 4)), linear(0, 2),
         "A value below 1 makes hair fuller than the groom, and one above 1 lets it lie closer."),
    says("volume", of(articulated, whole(AT(volume_sweeps), 1, 64)), linear(1, 40),
         "More sweeps keep the volume of hair more exactly, and each of them costs time."),
    says("volume", of(articulated, real(AT(volume_rate), "1/s", 0, 1e3)), linear(0, 20),
         "A smaller value parts hair that is too dense more slowly, and lets it rest more calmly."),
    says("volume", of(articulated, real(AT(volume_viscosity), "1/s", 0, 1e3)), linear(0, 50),
         "A larger value gives hair the velocity of the hair around it sooner."),
    says("volume", of(articulated, real(AT(cohesion), "m^2/s^2", 0, 1e4)), linear(0, 2),
         "A larger value makes hair hold together more before it parts."),

    says("wetness", of(articulated, real(AT(drying_time), "s", 0, 1e9)), linear(0, 600),
         "Wet hair dries with this time constant, and 0 keeps it wet."),
    says("wetness", of(articulated, real(AT(wet_cohesion), "m^2/s^2", 0, 1e4)), linear(0, 1),
         "A larger value makes wet hair that has volume hold together more, in locks."),

    says("strand_contact", of(articulated, choice(AT(strand_contact), strand_contacts)),
         "The choice on lets guides lie on one another, and off lets them pass through one "
         "another."),
    says("strand_contact", of(articulated, above(AT(strand_radius), "m", 0, 0.1)),
         logarithmic(1e-4, 1e-2), "Guides that meet stay twice this far apart."),
    says("strand_contact", of(articulated, real(AT(strand_friction), "", 0, 10)), linear(0, 2),
         "A larger value makes guides slide over one another less."),

    says("follows", whole(AT(follow_contact), 0, 1),
         "The value 1 turns follows out of bodies, and 0 leaves them where their guides put them."),

    says("push", real(AT(accelerate_values), "", -1e6, 1e6), linear(-10, 10),
         "The caller's kernel for the stage accelerate reads these values and says what they do to "
         "hair."),
};

// The defaults of the struct are those of the table.
auto with_defaults() {
    auto table = std::to_array(fields);
    const plait_sim_params params = default_params();
    for (plait_param_info& info : table)
        for (uint32_t i = 0; i < info.count && i < std::size(info.default_value); ++i)
            info.default_value[i] = param_component(info, params, i);
    return table;
}

} // namespace

std::span<const plait_param_info> param_table() {
    static const auto table = with_defaults();
    return table;
}

double param_component(const plait_param_info& param, const plait_sim_params& params,
                       uint32_t component) {
    const auto* const at =
        reinterpret_cast<const unsigned char*>(&params) + param.offset + size_t{4} * component;
    if (param.kind == PLAIT_PARAM_KIND_FLOAT) {
        float number;
        std::memcpy(&number, at, sizeof number);
        return double(number);
    }
    // C callers can put any number into an enum: a negative one is outside, too
    uint32_t number;
    std::memcpy(&number, at, sizeof number);
    return param.kind == PLAIT_PARAM_KIND_UINT ? double(number)
                                               : double(static_cast<int32_t>(number));
}

const char* model_name(plait_model model) {
    const auto number = static_cast<uint32_t>(model);
    return number < std::size(model_names) ? model_names[number] : "?";
}

} // namespace plait
