#include "common/params_reader.hpp"

namespace common {

const std::array<const char*, 4> model_names{"tressfx", "chain", "cosserat", "rod"};
const std::array<const char*, 3> interhair_names{"off", "slots", "exact"};
const std::array<const char*, 3> sag_free_names{"off", "rest", "stiffen"};

namespace {

constexpr std::array wind_names{"published", "drag"};
constexpr std::array follow_names{"published", "rotating"};
constexpr std::array shock_names{"threshold", "continuous"};
constexpr std::array order_names{"published", "shock_before_global"};
constexpr std::array hash_names{"thesis", "pcg"};
constexpr std::array tent_names{"voxel", "trilinear"};
constexpr std::array rule_names{"thesis", "floored"};

void read_model(JsonReader& in, plait_sim_params& p) {
    in.numbers("gravity", p.gravity, -1e4, 1e4);
    in.number("damping", p.damping, 0, 100);
    in.number("local_stiffness", p.local_stiffness, 0, 1);
    in.integer("local_iterations", p.local_iterations, 0, 64);
    in.number("global_stiffness", p.global_stiffness, 0, 1);
    in.number("global_range", p.global_range, 0, 1);
    in.integer("length_iterations", p.length_iterations, 0, 256);
    in.number("vsp_coeff", p.vsp_coeff, 0, 1);
    in.number("vsp_accel_threshold", p.vsp_accel_threshold, 0, 1e6);
    in.number("max_displacement", p.max_displacement, 1e-9, 1e6);
    in.number("tip_separation", p.tip_separation, 0, 100);
    in.choice("follow_form", p.follow_form, follow_names);
    in.choice("shock_form", p.shock_form, shock_names);
    in.choice("order", p.order, order_names);
}

void read_material(JsonReader& in, plait_sim_params& p) {
    in.integer("iterations", p.iterations, 0, 64);
    in.integer("bdf2", p.bdf2, 0, 1);
    in.number("line_density", p.line_density, 1e-9, 1e3);
    in.number("bend_stiffness", p.bend_stiffness, 0, 1e3);
    in.number("stretch_stiffness", p.stretch_stiffness, 0, 1e9);
    in.number("twist_stiffness", p.twist_stiffness, 0, 1e3);
    in.number("section_ratio", p.section_ratio, 1e-3, 1e3);
    in.number("tip_stiffness", p.tip_stiffness, 0, 100);
    in.number("drag", p.drag, 0, 1e4);
    in.integer("shape_constraints", p.shape_constraints, 0, 1);
    in.number("attachment", p.attachment, 0, 100);
}

void read_air(JsonReader& in, plait_sim_params& p) {
    in.choice("wind_form", p.wind_form, wind_names);
    in.numbers("wind", p.wind, -1e3, 1e3);
    in.number("air_drag", p.air_drag, 0, 1e6);
    in.number("wind_cone", p.wind_cone, 0, 1.5707964);
}

void read_interhair(JsonReader& in, plait_sim_params& p) {
    in.choice("interhair", p.interhair, interhair_names);
    in.integer("grid_edge_count", p.grid_edge_count, 1, 64);
    in.integer("slot_capacity", p.slot_capacity, 1, 65536);
    in.choice("slot_hash", p.slot_hash, hash_names);
    in.choice("tent", p.tent, tent_names);
    in.choice("diffuse_rule", p.diffuse_rule, rule_names);
    in.number("diffuse_ratio", p.diffuse_ratio, 0, 1e6);
    in.number("diffuse_factor", p.diffuse_factor, 0, 1);
    in.number("diffuse_floor", p.diffuse_floor, 0, 1);
    in.integer("grid_in_world", p.grid_in_world, 0, 1);
    in.numbers("grid_origin", p.grid_origin, -1e6, 1e6);
    in.number("grid_edge", p.grid_edge, 0, 1e6);
}

} // namespace

void read_params(JsonReader in, plait_sim_params& params) {
    read_model(in, params);
    read_material(in, params);
    read_air(in, params);
    read_interhair(in, params);
    in.finish();
}

} // namespace common
