#include "core/sim/prepare.hpp"

#include "base/format.hpp"
#include "core/grid/strand_grid.hpp"
#include "core/params/params.hpp"
#include "core/strand_contact/pairs.hpp"
#include "core/wind/wind_grid.hpp"

#include <string_view>
#include <vector>

namespace plait {
namespace {

constexpr uint32_t tressfx = 1u << PLAIT_MODEL_TRESSFX, lanes = 1u << PLAIT_MODEL_ARTICULATED,
                   any = tressfx | lanes;

constexpr uint32_t always = ~0u;
constexpr uint32_t grids = PLAIT_FEATURE_GRID | PLAIT_FEATURE_WIND;    // exact sums of hair
constexpr uint32_t solids = PLAIT_FEATURE_VOLUME | PLAIT_FEATURE_WIND; // nodes inside of bodies
constexpr uint32_t clears =
    grids | PLAIT_FEATURE_SLOTS | PLAIT_FEATURE_VOLUME | PLAIT_FEATURE_STRAND_CONTACT;
constexpr uint32_t clumps = PLAIT_FEATURE_DETAIL | PLAIT_FEATURE_WETNESS;

// Which sims take a stage: those of one of the models, with one of the features and one of the
// others.
struct Need {
    plait_stage stage;
    uint32_t models;
    uint32_t features = always, others = always;
};

// In the order of stages.def.
constexpr Need needs[] = {
    {PLAIT_STAGE_roots, any},
    {PLAIT_STAGE_skin, any, PLAIT_FEATURE_SKIN},
    {PLAIT_STAGE_skin_mesh, any, PLAIT_FEATURE_BOUND_ROOTS},
    {PLAIT_STAGE_mesh_take, any, PLAIT_FEATURE_BOUND_ROOTS | PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_mesh_advance, lanes, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_mesh_refit, lanes, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_tressfx_reset, tressfx},
    {PLAIT_STAGE_tressfx_teleport, tressfx},
    {PLAIT_STAGE_tressfx_set_off, tressfx},
    {PLAIT_STAGE_tressfx_carry, tressfx, PLAIT_FEATURE_FRAME},
    {PLAIT_STAGE_accelerate, 0}, // the caller's, built with the context
    {PLAIT_STAGE_integrate, tressfx},
    {PLAIT_STAGE_strand_data, tressfx},
    {PLAIT_STAGE_velocity_shock, tressfx},
    {PLAIT_STAGE_global_shape, tressfx},
    {PLAIT_STAGE_local_shape, tressfx},
    {PLAIT_STAGE_tressfx_wind, tressfx, PLAIT_FEATURE_WIND},
    {PLAIT_STAGE_length, tressfx},
    {PLAIT_STAGE_tressfx_collide, tressfx},
    {PLAIT_STAGE_clamp, tressfx},
    {PLAIT_STAGE_attach, tressfx},
    {PLAIT_STAGE_articulated, lanes},
    {PLAIT_STAGE_lane_accelerate, lanes, PLAIT_FEATURE_ACCELERATION},
    {PLAIT_STAGE_pins, lanes, PLAIT_FEATURE_PINS},
    {PLAIT_STAGE_lane_pin, lanes, PLAIT_FEATURE_PINS},
    {PLAIT_STAGE_lane_groom, lanes, PLAIT_FEATURE_GROOM},
    {PLAIT_STAGE_mesh_field, lanes, PLAIT_FEATURE_MESHES},
    {PLAIT_STAGE_mesh_nearest, lanes, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_contact_pair_count, lanes, PLAIT_FEATURE_STRAND_CONTACT},
    {PLAIT_STAGE_contact_pair_scan, lanes, PLAIT_FEATURE_STRAND_CONTACT},
    {PLAIT_STAGE_contact_pair_fill, lanes, PLAIT_FEATURE_STRAND_CONTACT},
    {PLAIT_STAGE_contact_pair_find, lanes, PLAIT_FEATURE_STRAND_CONTACT},
    {PLAIT_STAGE_strand_contact, lanes, PLAIT_FEATURE_STRAND_CONTACT},
    {PLAIT_STAGE_lane_reset, lanes},
    {PLAIT_STAGE_lane_teleport, lanes},
    {PLAIT_STAGE_lane_set_off, lanes},
    {PLAIT_STAGE_lane_carry, lanes, PLAIT_FEATURE_FRAME},
    {PLAIT_STAGE_lane_unpack, lanes},
    {PLAIT_STAGE_lane_pack, lanes},
    {PLAIT_STAGE_lane_orient, lanes},
    {PLAIT_STAGE_wind_field, lanes, PLAIT_FEATURE_WIND},
    {PLAIT_STAGE_grid_solid_field, lanes, solids, PLAIT_FEATURE_MESHES},
    {PLAIT_STAGE_grid_solid_cross, lanes, solids, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_grid_solid_fill, lanes, solids, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_wind_obstacle, lanes, PLAIT_FEATURE_WIND},
    {PLAIT_STAGE_wind_shelter, lanes, PLAIT_FEATURE_WIND},
    {PLAIT_STAGE_lane_wind, lanes, PLAIT_FEATURE_WIND},
    {PLAIT_STAGE_wetness, lanes, PLAIT_FEATURE_WETNESS},
    {PLAIT_STAGE_lane_wetness, lanes, PLAIT_FEATURE_WETNESS},
    {PLAIT_STAGE_lane_move, lanes, PLAIT_FEATURE_SWITCHES},
    {PLAIT_STAGE_lane_fit, lanes, PLAIT_FEATURE_SWITCHES},
    {PLAIT_STAGE_level_wake, lanes, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_grid_clear, any, clears},
    {PLAIT_STAGE_grid_slots, any, PLAIT_FEATURE_SLOTS},
    {PLAIT_STAGE_grid_density, any, PLAIT_FEATURE_SLOTS},
    {PLAIT_STAGE_grid_velocity, any, PLAIT_FEATURE_SLOTS},
    {PLAIT_STAGE_grid_splat, any, grids},
    {PLAIT_STAGE_lane_splat, lanes, grids},
    {PLAIT_STAGE_lane_diffuse, lanes, PLAIT_FEATURE_GRID},
    {PLAIT_STAGE_grid_resolve, any, grids},
    {PLAIT_STAGE_grid_diffuse, any, PLAIT_FEATURE_GRID | PLAIT_FEATURE_SLOTS},
    {PLAIT_STAGE_volume_splat, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_volume_nodes, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_volume_faces, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_volume_pressure, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_volume_impulse, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_volume_gather, lanes, PLAIT_FEATURE_VOLUME},
    {PLAIT_STAGE_output_keep, any},
    {PLAIT_STAGE_output, any},
    {PLAIT_STAGE_tressfx_follow, any, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_guide_turns, any, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_follow_turns, any, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_follow_clump, any, PLAIT_FEATURE_FOLLOWS, clumps},
    {PLAIT_STAGE_follow_curl, any, PLAIT_FEATURE_FOLLOWS, PLAIT_FEATURE_DETAIL},
    {PLAIT_STAGE_follow_collide, any, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_follow_field, lanes, PLAIT_FEATURE_FOLLOWS, PLAIT_FEATURE_MESHES},
    {PLAIT_STAGE_follow_nearest, lanes, PLAIT_FEATURE_FOLLOWS, PLAIT_FEATURE_BENDING_MESHES},
    {PLAIT_STAGE_level_keep, lanes, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_level_show, lanes, PLAIT_FEATURE_FOLLOWS},
    {PLAIT_STAGE_tangents, any},
    {PLAIT_STAGE_last_frame, any},
    {PLAIT_STAGE_bounds, any},
    {PLAIT_STAGE_stats, any},
};
static_assert(std::size(needs) == PLAIT_STAGE_COUNT && [] {
    for (size_t i = 0; i < std::size(needs); ++i)
        if (static_cast<size_t>(needs[i].stage) != i)
            return false;
    return true;
}());

// Whether sims see hair where the lanes have it, or where it was published: Sim::grid_is_over_lanes().
bool is_read_so(const Context& context, plait_stage stage, const Preparation& of) {
    const bool own =
        context.replaced[PLAIT_STAGE_grid_splat] || context.replaced[PLAIT_STAGE_grid_diffuse];
    const bool over_lanes =
        context.info.lanes > 1 && context.device.supports(PLAIT_STAGE_lane_splat);
    switch (stage) {
    case PLAIT_STAGE_lane_splat:
        return over_lanes;
    case PLAIT_STAGE_lane_diffuse:
        return over_lanes && !own && context.device.supports(stage);
    case PLAIT_STAGE_grid_splat:
        return !over_lanes || own || of.models & tressfx;
    case PLAIT_STAGE_grid_diffuse:
        return !over_lanes || own || of.models & tressfx || of.features & PLAIT_FEATURE_SLOTS ||
               !context.device.supports(PLAIT_STAGE_lane_diffuse);
    default:
        return true;
    }
}

bool will_run(const Context& context, const Need& need, const Preparation& of) {
    const uint32_t features = of.features | ~uint32_t{PLAIT_FEATURE_ALL}; // of `always`, too
    return need.models & of.models && need.features & features && need.others & features &&
           is_read_so(context, need.stage, of);
}

// Where nobody knows how many: guides, and follows for each.
constexpr uint32_t usual_strands = 1u << 11, usual_follows = 8;

// A grid for wind has more nodes than the usual one, whose sums may be kept elsewhere.
plait_grid_params wind_grid() {
    plait_grid_params params{};
    params.vertex_stride = params.capacity = 1;
    params.edge_count = WindGrid::nodes;
    params.voxel_edge = 1;
    return params;
}

// Of one stage, for as many items as there will be: compilers may tell few from many.
std::vector<plait_dispatch> dispatches(const Context& context, const plait_stage_info& stage,
                                       const Preparation& of, const plait_grid_params& wind) {
    const uint32_t strands = of.strands > 0 ? of.strands : usual_strands;
    std::vector<plait_dispatch> list;
    const auto add = [&](uint32_t items, uint32_t width, const void* params = nullptr) {
        list.push_back(
            {stage.stage, items, width, params, stage.params_size, stage.buffer_count, nullptr, 0});
    };
    const bool follows = std::string_view(stage.name).starts_with("follow") ||
                         stage.stage == PLAIT_STAGE_tressfx_follow;
    const bool of_all =
        follows || (of.features & PLAIT_FEATURE_FOLLOWS &&
                    (stage.stage == PLAIT_STAGE_tangents || stage.stage == PLAIT_STAGE_last_frame));
    switch (stage.space) {
    case PLAIT_SPACE_LANES:
        for (const uint32_t row : follows ? std::span(&of.row, 1) : of.rows)
            add(strands, row);
        break;
    case PLAIT_SPACE_STRAND_GROUP:
        add(strands, of.row);
        break;
    case PLAIT_SPACE_VOXEL: // of the usual grids there are few
        add(1, 1);
        break;
    case PLAIT_SPACE_VOXEL_GROUP:
        add(1, stage.stage == PLAIT_STAGE_contact_pair_scan ? Pairs::group_width(context.info)
               : stage.stage == PLAIT_STAGE_wind_shelter
                   ? WindGrid::group_width(context.info)
                   : StrandGrid::group_width(context.info, default_grid_desc().slot_capacity));
        break;
    case PLAIT_SPACE_WORD: // of meshes and bounds there are few, of grids' cells there may be many
        add(1, 1);
        if (stage.stage == PLAIT_STAGE_grid_clear)
            add(strands * of.row, 1);
        break;
    case PLAIT_SPACE_VERTEX:
    case PLAIT_SPACE_STRAND: {
        const uint32_t items = strands * (stage.space == PLAIT_SPACE_VERTEX ? of.row : 1);
        add(items, 1);
        if (of_all)
            add(items * usual_follows, 1);
        if (stage.stage == PLAIT_STAGE_grid_splat && of.features & PLAIT_FEATURE_WIND)
            add(1, 1, &wind);
        break;
    }
    case PLAIT_SPACE_FORCE_32:
        break;
    }
    return list;
}

} // namespace

Status prepare(Context& context, const Preparation& of) {
    const plait_grid_params wind = wind_grid();
    std::vector<std::vector<plait_dispatch>> stages;
    for (const Need& need : needs)
        if (will_run(context, need, of)) {
            stages.push_back(dispatches(context, *plait_stage_describe(need.stage), of, wind));
            PLAIT_TRY(check_supported(context.device, stages.back()));
        }
    const auto total = static_cast<uint32_t>(stages.size());
    uint32_t done = 0;
    const auto goes_on = [&](const char* name) { return of.progress(done, total, name); };
    for (; done < total; ++done) {
        if (!goes_on(plait_stage_describe(stages[done].front().stage)->name))
            break;
        PLAIT_TRY(context.device.prepare(stages[done]));
    }
    PLAIT_TRY(context.device.wait()); // backends keep what they have made
    if (done < total)
        return Error{PLAIT_CANCELLED,
                     format("the caller's progress ended it after %u of %u stages", done, total)};
    (void)goes_on("");
    return {};
}

} // namespace plait
