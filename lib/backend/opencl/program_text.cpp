#include "backend/opencl/program_text.hpp"

#include "backend/opencl/source.hpp"
#include "base/format.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace plait::opencl {
namespace {

struct Group {
    const char* name;
    std::initializer_list<plait_stage> stages; // all over lanes, or none
};

// The kernels of a group treat a*b + c alike (FP_CONTRACT), as do the headers that they share, and come
// out as they do alone: a function that two of them call might be inlined in neither.
const Group groups[] = {
    {"shown",
     {PLAIT_STAGE_roots, PLAIT_STAGE_skin, PLAIT_STAGE_output_keep, PLAIT_STAGE_output,
      PLAIT_STAGE_tangents, PLAIT_STAGE_last_frame, PLAIT_STAGE_bounds, PLAIT_STAGE_stats,
      PLAIT_STAGE_lane_pack, PLAIT_STAGE_wetness}},
    {"lane_state",
     {PLAIT_STAGE_lane_reset, PLAIT_STAGE_lane_teleport, PLAIT_STAGE_lane_set_off,
      PLAIT_STAGE_lane_carry, PLAIT_STAGE_lane_orient}},
    {"lane_forces", {PLAIT_STAGE_lane_pin, PLAIT_STAGE_lane_groom, PLAIT_STAGE_lane_accelerate}},
    {"lane_switch", {PLAIT_STAGE_lane_move, PLAIT_STAGE_lane_fit}},
    {"tressfx",
     {PLAIT_STAGE_tressfx_reset, PLAIT_STAGE_tressfx_teleport, PLAIT_STAGE_tressfx_set_off,
      PLAIT_STAGE_tressfx_carry, PLAIT_STAGE_integrate, PLAIT_STAGE_strand_data,
      PLAIT_STAGE_velocity_shock, PLAIT_STAGE_global_shape, PLAIT_STAGE_length, PLAIT_STAGE_clamp,
      PLAIT_STAGE_attach, PLAIT_STAGE_tressfx_wind, PLAIT_STAGE_tressfx_collide}},
    {"bent",
     {PLAIT_STAGE_skin_mesh, PLAIT_STAGE_mesh_take, PLAIT_STAGE_mesh_advance,
      PLAIT_STAGE_mesh_refit}},
    {"air", {PLAIT_STAGE_wind_field, PLAIT_STAGE_wind_shelter}},
    {"solid",
     {PLAIT_STAGE_grid_solid_field, PLAIT_STAGE_grid_solid_cross, PLAIT_STAGE_grid_solid_fill}},
    {"grid",
     {PLAIT_STAGE_grid_clear, PLAIT_STAGE_grid_slots, PLAIT_STAGE_grid_density,
      PLAIT_STAGE_grid_velocity, PLAIT_STAGE_grid_resolve, PLAIT_STAGE_grid_diffuse}},
    {"volume",
     {PLAIT_STAGE_volume_nodes, PLAIT_STAGE_volume_faces, PLAIT_STAGE_volume_pressure,
      PLAIT_STAGE_volume_impulse}},
    {"pairs",
     {PLAIT_STAGE_contact_pair_count, PLAIT_STAGE_contact_pair_scan,
      PLAIT_STAGE_contact_pair_fill}},
    {"follows", {PLAIT_STAGE_guide_turns, PLAIT_STAGE_follow_clump}},
    {"levels", {PLAIT_STAGE_level_wake, PLAIT_STAGE_level_keep, PLAIT_STAGE_level_show}},
    {"offsets", {PLAIT_STAGE_tressfx_follow, PLAIT_STAGE_follow_curl}},
};

std::string name_of(plait_stage stage) {
    return plait_stage_describe(stage)->name;
}

std::string name_in_cl(plait_stage stage) {
    return stage_file(name_of(stage)).substr(std::string_view("cl/").size());
}

} // namespace

StageText program_text(plait_stage stage) {
    for (const Group& group : groups) {
        if (std::ranges::find(group.stages, stage) == group.stages.end())
            continue;
        std::string text;
        for (const plait_stage each : group.stages)
            text += format("#include \"%s\"\n", name_in_cl(each).c_str());
        return {format("cl/(%s)", group.name), text};
    }
    return {stage_file(name_of(stage)), std::string(stage_text(name_of(stage)))};
}

} // namespace plait::opencl
