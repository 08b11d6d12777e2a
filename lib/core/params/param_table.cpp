#include "core/params/param_table.hpp"

#include "core/groom/materials.hpp"
#include "core/params/params.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

namespace plait {
namespace {

constexpr const char* wind_forms[] = {"published", "drag"};
constexpr const char* follow_forms[] = {"published", "rotating"};
constexpr const char* shock_forms[] = {"threshold", "continuous"};
constexpr const char* orders[] = {"published", "shock_before_global"};
constexpr const char* grid_forms[] = {"slots", "exact"};
constexpr const char* slot_hashes[] = {"thesis", "pcg"};
constexpr const char* tents[] = {"voxel", "trilinear"};
constexpr const char* diffuse_rules[] = {"thesis", "floored"};

// In the order of plait_model.
constexpr const char* model_names[] = {"tressfx", "articulated"};

// Who reads a parameter.
constexpr uint32_t tressfx = 1u << PLAIT_MODEL_TRESSFX, articulated = 1u << PLAIT_MODEL_ARTICULATED;
constexpr uint32_t every_model = tressfx | articulated;

struct Field {
    const char *feature, *name;
    size_t offset, size;
};
#define IN(feature, type, field, name)                                                             \
    Field {                                                                                        \
        feature, name, offsetof(type, field), sizeof(type::field)                                  \
    }
#define PARAM(field) IN("params", plait_sim_params, field, #field)
#define MATERIAL(field) IN("material", plait_material, field, #field)
#define TRESSFX(field) IN("tressfx", plait_tressfx_desc, field, #field)
#define GRID(field) IN("grid", plait_grid_desc, field, "grid_" #field)
#define VOLUME(field) IN("volume", plait_volume_desc, field, "volume_" #field)
#define STRAND_CONTACT(field)                                                                      \
    IN("strand_contact", plait_strand_contact_desc, field, "strand_contact_" #field)
#define WETNESS(field) IN("wetness", plait_wetness_desc, field, "wetness_" #field)
#define ACCELERATION(field)                                                                        \
    IN("acceleration", plait_acceleration_desc, field, "acceleration_" #field)

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
    info.feature = at.feature;
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
constexpr plait_param_info says(plait_param_info info, const char* text) {
    info.text = text;
    return info;
}
constexpr plait_param_info says(plait_param_info info, const Slider& slider, const char* text) {
    info.slider_least = slider.least;
    info.slider_most = slider.most;
    info.slider_log = slider.logarithmic;
    return says(info, text);
}

constexpr plait_param_info fields[] = {
    says(real(PARAM(gravity), "m/s^2", -1e4, 1e4), linear(-20, 20),
         "Gravity pulls all hair with this acceleration."),
    says(whole(PARAM(follow_contact), 0, 1),
         "The value 1 turns follows out of bodies, and 0 leaves them where their guides put them."),
    says(real(PARAM(tip_separation), "", 0, 100), linear(0, 2),
         "A larger value spreads the tips of follows farther from their guide."),
    says(choice(PARAM(follow_form), follow_forms),
         "The form rotating turns follows with their guide, and published only moves them along."),
    says(of(articulated, real(PARAM(drag), "1/s", 0, 1e4)), linear(0, 20),
         "A larger value makes the air brake hair more, so that it stops swinging sooner."),
    says(of(articulated, real(PARAM(air_with_head), "", 0, 1)),
         "The air takes on this share of the head's velocity, so that a moving head's hair lags "
         "behind less."),
    says(of(articulated, real(PARAM(groom), "", 0, 1)),
         "A larger value keeps hair closer to its groomed shape, and at 1 it stays in that shape."),
    says(of(articulated, whole(PARAM(iterations), 0, 64)), linear(1, 8),
         "More Newton steps solve the motion of stiff or fast hair more exactly, and each costs "
         "time."),
    says(of(articulated, whole(PARAM(bdf2), 0, 1)),
         "The value 1 damps a swing little, 0 damps it more, and the default is 1 unless "
         "strand_contact is on."),

    says(of(articulated, real(MATERIAL(line_density), "kg/m", 1e-9, 1e3)), logarithmic(1e-6, 1e-3),
         "A larger value makes hair heavier, so that it sags more under its weight."),
    says(of(articulated, real(MATERIAL(bend_stiffness), "N m^2", 0, 1e3)), logarithmic(1e-10, 1e-5),
         "A larger value makes hair harder to bend, so that it sags less and springs back faster."),
    // Kernels of the caller's may read it.
    says(of(0, real(MATERIAL(stretch_stiffness), "N", 0, 1e9)), logarithmic(1e-2, 1e2),
         "A larger value makes hair of the caller's kernels harder to stretch, and 0 lets the "
         "library choose."),
    says(of(articulated, real(MATERIAL(twist_stiffness), "N m^2", 0, 1e3)),
         logarithmic(1e-10, 1e-5),
         "A larger value makes hair harder to twist, so that curls hang out less, and 0 takes "
         "bend_stiffness."),
    says(of(articulated, real(MATERIAL(section_ratio), "", 1e-3, 1e3)), logarithmic(0.1, 10),
         "A value other than 1 makes hair flat, so that it bends more easily about one axis than "
         "the other."),
    says(of(articulated, real(MATERIAL(curl), "", 0, 4)), linear(0, 2),
         "A value below 1 straightens the curls of the groom, and one above 1 tightens them."),
    says(of(articulated, real(MATERIAL(clamp_stiffness), "", 0, 100)), linear(0, 2),
         "A smaller value holds hair less in the direction in which it leaves the skin."),
    says(of(articulated, real(MATERIAL(stiffness_ramp), "", 0, 100)), linear(0, 2),
         "Values that fall from root to tip make hair softer towards its tip."),
    says(of(articulated, real(MATERIAL(density_ramp), "", 1e-3, 1e3)), linear(0.1, 2),
         "Values that fall from root to tip make hair lighter towards its tip."),
    says(of(articulated, real(MATERIAL(drag_scale), "", 0, 100)), linear(0, 2),
         "A larger value lets the air brake and blow hair more."),
    says(of(articulated, real(MATERIAL(friction_scale), "", 0, 100)), linear(0, 2),
         "A larger value makes hair slide less over bodies and other hair."),
    says(of(articulated, real(MATERIAL(groom_stiffness), "N/m^2", 0, 1e6)), linear(0, 1),
         "A larger value holds hair closer to its groomed shape by a spring."),
    says(of(articulated, real(MATERIAL(groom_ramp), "", 0, 100)), linear(0, 2),
         "Values that fall from root to tip hold hair in its groomed shape less towards its tip."),

    says(of(tressfx, real(TRESSFX(damping), "", 0, 100)), linear(0, 1),
         "A larger value slows hair down sooner, against the world and not against the head."),
    says(of(tressfx, real(TRESSFX(local_stiffness), "", 0, 1)),
         "A larger value draws each segment more strongly to its groomed direction from the one "
         "before."),
    says(of(tressfx, whole(TRESSFX(local_iterations), 0, 64)), linear(0, 16),
         "More iterations make hair stiffer, and each of them costs time."),
    says(of(tressfx, real(TRESSFX(global_stiffness), "", 0, 1)),
         "A larger value draws the part of a strand near its root more strongly to where it was "
         "groomed."),
    says(of(tressfx, real(TRESSFX(global_range), "", 0, 1)),
         "This share of each strand, from the root on, feels global_stiffness."),
    says(of(tressfx, whole(TRESSFX(length_iterations), 0, 256)), linear(0, 64),
         "More iterations leave hair less stretched, and each of them costs time."),
    says(of(tressfx, real(TRESSFX(vsp_coeff), "", 0, 1)),
         "A larger value carries hair along with the motion of its root more closely."),
    says(of(tressfx, real(TRESSFX(vsp_accel_threshold), "m", 0, 1e6)), linear(0, 5),
         "Hair takes on all of its root's motion when that changes by more than this from one step "
         "to the next."),
    says(of(tressfx, above(TRESSFX(max_displacement), "m", 0, 1e6)), logarithmic(1e-3, 1),
         "No vertex moves farther than this in a substep, and the default switches the limit off."),
    says(of(tressfx, real(TRESSFX(attachment), "", 0, 100)), linear(0, 2),
         "No vertex gets farther from its root than this times the length of hair between them, "
         "and 0 sets no limit."),
    says(of(tressfx, real(TRESSFX(wind), "m/s", -1e3, 1e3)), linear(-30, 30),
         "The air moves with this velocity, and drag says how fast it takes hair along."),
    says(of(tressfx, real(TRESSFX(air_drag), "1/m", 0, 1e6)), linear(0, 20),
         "A larger value makes the wind push hair more, and still air brake it more."),
    says(of(tressfx, real(TRESSFX(wind_cone), "rad", 0, std::numbers::pi / 2)),
         "The published form of the wind spreads its directions over a cone of this half angle."),
    says(of(tressfx, choice(TRESSFX(wind_form), wind_forms)),
         "The form drag blows hair with the wind in SI units, and published blows it as TressFX "
         "does."),
    says(of(tressfx, choice(TRESSFX(shock_form), shock_forms)),
         "The form threshold lets hair take on its root's motion with a jump, and continuous "
         "without one."),
    says(of(tressfx, choice(TRESSFX(order), orders)),
         "The order shock_before_global keeps hair together after a jump of the head, which "
         "published does not."),

    says(choice(GRID(form), grid_forms),
         "The form exact sums up all hair in a voxel, and slots samples it as the thesis does."),
    says(whole(GRID(edge_count), 1, 64), linear(4, 64),
         "More voxels along each edge compare hair with nearer hair only."),
    says(whole(GRID(slot_capacity), 1, 65536), logarithmic(64, 16384),
         "More slots in a voxel sample more of its hair, and take more memory."),
    says(choice(GRID(slot_hash), slot_hashes),
         "The rule pcg samples the hair in a voxel evenly, and thesis samples it as published."),
    says(choice(GRID(tent), tents),
         "The form trilinear slows hair smoothly across voxels, and voxel with a jump at their "
         "borders."),
    says(choice(GRID(diffuse_rule), diffuse_rules),
         "The rule thesis slows all hair where hair swings to and fro, and floored only the "
         "fastest of it."),
    says(real(GRID(diffuse_ratio), "", 0, 1e6), linear(0, 5),
         "A smaller value slows more hair: all that is faster than this times the hair around it."),
    says(real(GRID(diffuse_factor), "", 0, 1),
         "A smaller value slows hair that is too fast more: it keeps this share of its velocity in "
         "a step."),
    says(real(GRID(diffuse_floor), "", 0, 1),
         "A larger value leaves more hair alone where the hair around it swings to and fro."),
    says(whole(GRID(in_world), 0, 1),
         "The value 0 lets the grid go with the head, and 1 fixes it in the world."),
    says(real(GRID(origin), "m", -1e6, 1e6), linear(-2, 2),
         "The grid has its corner here if grid_edge is above 0, and hair outside of it is not "
         "slowed."),
    says(real(GRID(edge), "m", 0, 1e6), linear(0, 2),
         "The grid is a cube with edges of this length, and 0 fits it around the groom."),

    says(of(articulated, real(VOLUME(share), "", 0, 4)), linear(0, 2),
         "A value below 1 makes hair fuller than the groom, and one above 1 lets it lie closer."),
    says(of(articulated, whole(VOLUME(sweeps), 1, 64)), linear(1, 40),
         "More sweeps keep the volume of hair more exactly, and each of them costs time."),
    says(of(articulated, real(VOLUME(rate), "1/s", 0, 1e3)), linear(0, 20),
         "A smaller value parts hair that is too dense more slowly, and lets it rest more calmly."),
    says(of(articulated, real(VOLUME(viscosity), "1/s", 0, 1e3)), linear(0, 50),
         "A larger value gives hair the velocity of the hair around it sooner."),
    says(of(articulated, real(VOLUME(cohesion), "m^2/s^2", 0, 1e4)), linear(0, 2),
         "A larger value makes hair hold together more before it parts."),

    says(of(articulated, above(STRAND_CONTACT(radius), "m", 0, 0.1)), logarithmic(1e-4, 1e-2),
         "Guides that meet stay twice this far apart."),
    says(of(articulated, real(STRAND_CONTACT(friction), "", 0, 10)), linear(0, 2),
         "A larger value makes guides slide over one another less."),

    says(of(articulated, real(WETNESS(drying_time), "s", 0, 1e9)), linear(0, 600),
         "Wet hair dries with this time constant, and 0 keeps it wet."),
    says(of(articulated, real(WETNESS(cohesion), "m^2/s^2", 0, 1e4)), linear(0, 1),
         "A larger value makes wet hair that has volume hold together more, in locks."),

    says(real(ACCELERATION(values), "", -1e6, 1e6), linear(-10, 10),
         "The caller's kernel for the stage accelerate reads these values and says what they do to "
         "hair."),
};

// The defaults of the structs are those of the table.
auto with_defaults() {
    auto table = std::to_array(fields);
    const NamedParams defaults{default_params(), default_material()};
    for (plait_param_info& info : table)
        for (uint32_t i = 0; i < info.count && i < std::size(info.default_value); ++i)
            info.default_value[i] = param_component(info, defaults, i);
    return table;
}

// The struct that the field lies in.
const void* struct_of(const plait_param_info& param, const NamedParams& all) {
    const Params& params = all.params;
    const std::string_view feature = param.feature;
    if (feature == "material")
        return &all.material;
    if (feature == "tressfx")
        return &params.tressfx;
    if (feature == "grid")
        return static_cast<const plait_grid_desc*>(&params.grid);
    if (feature == "volume")
        return static_cast<const plait_volume_desc*>(&params.volume);
    if (feature == "strand_contact")
        return static_cast<const plait_strand_contact_desc*>(&params.strand_contact);
    if (feature == "wetness")
        return static_cast<const plait_wetness_desc*>(&params.wetness);
    if (feature == "acceleration")
        return static_cast<const plait_acceleration_desc*>(&params.acceleration);
    return static_cast<const plait_sim_params*>(&params);
}

} // namespace

std::span<const plait_param_info> param_table() {
    static const auto table = with_defaults();
    return table;
}

const unsigned char* param_at(const plait_param_info& param, const NamedParams& all) {
    return static_cast<const unsigned char*>(struct_of(param, all)) + param.offset;
}

unsigned char* param_at(const plait_param_info& param, NamedParams& all) {
    return const_cast<unsigned char*>(param_at(param, std::as_const(all)));
}

double param_component(const plait_param_info& param, const NamedParams& all, uint32_t component) {
    const unsigned char* const at = param_at(param, all) + size_t{4} * component;
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

bool feature_is_on(const plait_param_info& param, const Params& params) {
    const std::string_view feature = param.feature;
    return !((feature == "grid" && !params.grid.on) || (feature == "volume" && !params.volume.on) ||
             (feature == "strand_contact" && !params.strand_contact.on) ||
             (feature == "wetness" && !params.wetness.on) ||
             (feature == "acceleration" && !params.acceleration.on));
}

const char* model_name(plait_model model) {
    const auto number = static_cast<uint32_t>(model);
    return number < std::size(model_names) ? model_names[number] : "?";
}

} // namespace plait
