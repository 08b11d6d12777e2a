// Every field of every parameter struct. The sensitivity check refuses a struct with a gap here.
#include "case.hpp"

#include <cstddef>

namespace plait::cases {

const std::vector<Field>& fields_of(const char* params_type) {
#define FIELD(type, name, kind)                                                                    \
    { #name, offsetof(type, name), sizeof(type::name) / 4, FieldKind::kind }
    static const std::map<std::string, std::vector<Field>> fields = {
        {"plait_roots_params",
         {FIELD(plait_roots_params, head_from_q, real),
          FIELD(plait_roots_params, head_from_t, vector),
          FIELD(plait_roots_params, head_to_q, real), FIELD(plait_roots_params, head_to_t, vector),
          FIELD(plait_roots_params, alpha, real), FIELD(plait_roots_params, per_root, choice)}},
        {"plait_layout_params", {FIELD(plait_layout_params, vertex_stride, layout)}},
        {"plait_integrate_params",
         {FIELD(plait_integrate_params, vertex_stride, layout),
          FIELD(plait_integrate_params, h, real), FIELD(plait_integrate_params, damping, real),
          FIELD(plait_integrate_params, global_stiffness, real),
          FIELD(plait_integrate_params, global_range, real),
          FIELD(plait_integrate_params, gravity, real)}},
        {"plait_global_shape_params",
         {FIELD(plait_global_shape_params, vertex_stride, layout),
          FIELD(plait_global_shape_params, stiffness, real),
          FIELD(plait_global_shape_params, range, real)}},
        {"plait_strand_data_params",
         {FIELD(plait_strand_data_params, vertex_stride, layout),
          FIELD(plait_strand_data_params, vsp_coeff, real),
          FIELD(plait_strand_data_params, vsp_accel_threshold, real),
          FIELD(plait_strand_data_params, shock_form, choice)}},
        {"plait_local_shape_params",
         {FIELD(plait_local_shape_params, vertex_stride, layout),
          FIELD(plait_local_shape_params, stiffness, real),
          FIELD(plait_local_shape_params, iterations, count)}},
        {"plait_wind_params",
         {FIELD(plait_wind_params, vertex_stride, layout), FIELD(plait_wind_params, h, real),
          FIELD(plait_wind_params, form, choice), FIELD(plait_wind_params, drag, real),
          FIELD(plait_wind_params, wind, vector), FIELD(plait_wind_params, corner, vector)}},
        {"plait_length_params",
         {FIELD(plait_length_params, vertex_stride, layout),
          FIELD(plait_length_params, iterations, count)}},
        {"plait_collide_params",
         {FIELD(plait_collide_params, vertex_stride, layout),
          FIELD(plait_collide_params, collider_count, layout),
          FIELD(plait_collide_params, alpha_from, real),
          FIELD(plait_collide_params, alpha_to, real)}},
        {"plait_clamp_params",
         {FIELD(plait_clamp_params, vertex_stride, layout),
          FIELD(plait_clamp_params, max_displacement, real)}},
        {"plait_attach_params",
         {FIELD(plait_attach_params, vertex_stride, layout),
          FIELD(plait_attach_params, reach, real)}},
        {"plait_follow_params",
         {FIELD(plait_follow_params, vertex_stride, layout),
          FIELD(plait_follow_params, guide_count, layout),
          FIELD(plait_follow_params, tip_separation, real),
          FIELD(plait_follow_params, form, choice)}},
        {"plait_grid_clear_params", {FIELD(plait_grid_clear_params, value, count)}},
        {"plait_grid_params",
         {FIELD(plait_grid_params, vertex_stride, layout),
          FIELD(plait_grid_params, edge_count, layout), FIELD(plait_grid_params, capacity, layout),
          FIELD(plait_grid_params, voxel_edge, real), FIELD(plait_grid_params, q, real),
          FIELD(plait_grid_params, t, vector), FIELD(plait_grid_params, h, real),
          FIELD(plait_grid_params, slot_hash, choice), FIELD(plait_grid_params, frame, count),
          FIELD(plait_grid_params, seed, count), FIELD(plait_grid_params, tent, choice),
          FIELD(plait_grid_params, diffuse_rule, choice),
          FIELD(plait_grid_params, diffuse_ratio, real),
          FIELD(plait_grid_params, diffuse_factor, real),
          FIELD(plait_grid_params, diffuse_floor, real)}},
        {"plait_lane_params",
         {FIELD(plait_lane_params, vertex_stride, layout), FIELD(plait_lane_params, tile, layout),
          FIELD(plait_lane_params, h, real), FIELD(plait_lane_params, iterations, count),
          FIELD(plait_lane_params, bdf2, choice), FIELD(plait_lane_params, drag, real),
          FIELD(plait_lane_params, gravity, real), FIELD(plait_lane_params, air, real),
          FIELD(plait_lane_params, collider_count, layout),
          FIELD(plait_lane_params, alpha_from, real), FIELD(plait_lane_params, alpha_to, real),
          FIELD(plait_lane_params, contact_rate, real),
          FIELD(plait_lane_params, contact_slip, real)}},
        {"plait_lane_state_params",
         {FIELD(plait_lane_state_params, vertex_stride, layout),
          FIELD(plait_lane_state_params, tile, layout),
          FIELD(plait_lane_state_params, history, choice)}},
        {"plait_lane_layout_params",
         {FIELD(plait_lane_layout_params, vertex_stride, layout),
          FIELD(plait_lane_layout_params, tile, layout), FIELD(plait_lane_layout_params, h, real)}},
        {"plait_output_params",
         {FIELD(plait_output_params, vertex_stride, layout),
          FIELD(plait_output_params, alpha, real)}},
    };
#undef FIELD
    static const std::vector<Field> none;
    const auto found = fields.find(params_type);
    return found == fields.end() ? none : found->second;
}

} // namespace plait::cases
