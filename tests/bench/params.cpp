#include "stage_sizes.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace bench {
namespace {

// Structs of nothing else than the layout and the step; any other without an overload below does not
// compile.
template <typename Params> void fill(Params& p, const Shape& shape) {
    constexpr bool tiled = requires {
        p.tile;
    }
    , rows = requires {
        p.row_stride;
    }
    , steps = requires {
        p.h;
    };
    static_assert(sizeof(Params) == 4 * (1 + tiled + rows + steps), "other fields need values");
    p.vertex_stride = shape.vertices;
    if constexpr (tiled)
        p.tile = shape.tile;
    if constexpr (rows)
        p.row_stride = shape.vertices;
    if constexpr (steps)
        p.h = step;
}
void fill(plait_roots_params& p, const Shape&) {
    p.head_before_q[3] = p.head_from_q[3] = p.head_to_q[3] = 1;
    p.head_to_t[0] = 0.01f;
    p.alpha = 1;
    p.per_root = 1;
}
void fill(plait_set_off_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 1, step, 0};
}
void fill(plait_carry_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, 1, 1, {0, 0, 0, 1}, {0.5f, 0, 0, 0}};
}
void fill(plait_integrate_params& p, const Shape& shape) {
    p = {shape.vertices, step, 0.08f, 0.4f, 0.3f, {0, -9.81f, 0}, 0};
}
void fill(plait_global_shape_params& p, const Shape& shape) {
    p = {shape.vertices, 0.4f, 0.3f};
}
void fill(plait_strand_data_params& p, const Shape& shape) {
    p = {shape.vertices, 0.8f, 1.4f, PLAIT_SHOCK_THRESHOLD};
}
void fill(plait_local_shape_params& p, const Shape& shape) {
    p = {shape.vertices, 0.9f, 2};
}
void fill(plait_tressfx_wind_params& p, const Shape& shape) {
    p.vertex_stride = shape.vertices;
    p.h = step;
    p.form = PLAIT_WIND_DRAG;
    p.drag = 1;
    p.wind[0] = 5;
}
void fill(plait_length_params& p, const Shape& shape) {
    p = {shape.vertices, 2};
}
void fill(plait_tressfx_collide_params& p, const Shape& shape) {
    p = {shape.vertices, colliders, 0};
}
void fill(plait_clamp_params& p, const Shape& shape) {
    p = {shape.vertices, 0.01f};
}
void fill(plait_attach_params& p, const Shape& shape) {
    p = {shape.vertices, 1};
}
void fill(plait_tressfx_follow_params& p, const Shape& shape) {
    p = {shape.vertices, shape.strands, 0.5f, PLAIT_FOLLOW_ROTATING};
}
void fill(plait_follow_turns_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.strands};
}
void fill(plait_follow_clump_params& p, const Shape& shape) {
    p = {shape.vertices, shape.strands, {0, 0.3f, 0.7f, 0.9f}, 0};
}
void fill(plait_follow_collide_params& p, const Shape& shape) {
    p = {shape.vertices, shape.strands, colliders, 0};
}
void fill(plait_follow_curl_params& p, const Shape& shape) {
    p = {shape.vertices,
         shape.strands,
         {0, 0.002f, 0.004f, 0.005f},
         0.02f,
         1,
         {0, 1e-3f, 2e-3f, 2e-3f},
         0.01f,
         1};
}
void fill(plait_wetness_params& p, const Shape&) {
    p.left = 0.5f;
}
void fill(plait_grid_clear_params& p, const Shape&) {
    p.value = PLAIT_SLOT_EMPTY;
}
void fill(plait_mesh_take_params& p, const Shape&) {
    p = {4, 1};
}
void fill(plait_mesh_advance_params& p, const Shape&) {
    p = {0, 0.5f, 1, 1};
}
void fill(plait_mesh_refit_params& p, const Shape&) {
    p = {0, 0, 32}; // the launch that has most to do
}
void fill(plait_grid_params& p, const Shape& shape) {
    p.vertex_stride = shape.vertices;
    p.edge_count = grid_edge_count;
    p.capacity = slot_capacity;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
    p.h = step;
    p.slot_hash = PLAIT_SLOT_HASH_PCG;
    p.tent = PLAIT_TENT_TRILINEAR;
    p.diffuse_rule = PLAIT_DIFFUSE_FLOORED;
    p.diffuse_ratio = 2;
    p.diffuse_factor = 0.9f;
    p.diffuse_floor = 0.5f;
}
void fill(plait_lane_params& p, const Shape& shape) {
    p = {shape.vertices,
         shape.tile,
         shape.vertices,
         step,
         3,
         0,
         1,
         {0, -9.81f, 0},
         {0, 0, 0},
         0,
         0,
         3e6f,
         1e-6f,
         0,
         0,
         0,
         0};
}
void fill(plait_pair_params& p, const Shape& shape) {
    const float length = strand_length / static_cast<float>(shape.vertices - 1);
    p = {shape.vertices, pair_cells, 0.8f * length, 1.1f * length, 0.004f, 0.5f * length, 1};
}
void fill(plait_contact_pair_scan_params& p, const Shape&) {
    p.edge_count = pair_cells;
}
void fill(plait_strand_contact_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0, 0.3f};
}
void fill(plait_accelerate_params& p, const Shape& shape) {
    p = {shape.vertices, step, 0, {}};
}
void fill(plait_pins_params& p, const Shape& shape) {
    p = {shape.vertices, 0.5f, 1, 1};
}
void fill(plait_last_frame_params& p, const Shape& shape) {
    p = {shape.vertices, 1};
}
void fill(plait_lane_pin_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0.5f, 1e4f, 1e5f, step, 300};
}
void fill(plait_lane_groom_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0, 1, step, 1e5f, 300};
}
void fill(plait_lane_tile_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0};
}
void fill(plait_wind_field_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count / 0.5f;
    p.q[3] = 1;
    p.amplitude = 1;
    p.octaves = 3;
    p.gain = 0.5f;
}
template <typename Params> void fill_solid(Params& p) {
    p.edge_count = grid_edge_count;
    p.q[3] = 1;
    p.collider_count = 1;
    if constexpr (requires { p.voxel_edge; }) {
        p.voxel_edge = grid_size / grid_edge_count;
        p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
    }
}
void fill(plait_grid_solid_field_params& p, const Shape&) {
    fill_solid(p);
    p.h = step;
}
void fill(plait_grid_solid_cross_params& p, const Shape&) {
    fill_solid(p);
}
void fill(plait_grid_solid_fill_params& p, const Shape&) {
    fill_solid(p);
    p.h = step;
}
void fill(plait_wind_obstacle_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
    p.extinction = 0.1f;
    p.collider_count = colliders;
}
void fill(plait_wind_shelter_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.plane = 1;
    p.foot[0] = p.foot[1] = 0.3f;
    p.way = 1.1f * p.voxel_edge;
    p.turbulent = 1;
    p.air[0] = 3;
}
void fill(plait_lane_wind_params& p, const Shape& shape) {
    p.vertex_stride = p.row_stride = shape.vertices;
    p.tile = shape.tile;
    p.h = step;
    p.bdf2 = 1;
    p.drag = 4.2e-5f;
    p.viscous = 3.6f;
    p.tangential = 0.3f;
    p.air[0] = 3;
    p.field = 1;
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
}
void fill(plait_lane_volume_params& p, const Shape& shape) {
    p.vertex_stride = shape.vertices;
    p.tile = shape.tile;
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
    p.moves = 1;
}
void fill(plait_volume_nodes_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.q[3] = 1;
    p.t[0] = p.t[1] = p.t[2] = -grid_size / 2;
    p.collider_count = colliders;
    p.h = step;
}
void fill(plait_volume_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
    p.voxel_edge = grid_size / grid_edge_count;
    p.h = step;
    p.share = 1;
    p.slack = 0.035f;
    p.onset = 0.15f;
    p.recovery = 0.2f;
    p.most_recovery = 0.08f;
    p.carried = 1;
}
void fill(plait_volume_sweep_params& p, const Shape&) {
    p.edge_count = grid_edge_count;
}
void fill(plait_volume_impulse_params& p, const Shape&) {
    p = {grid_edge_count, grid_size / grid_edge_count, step, 5};
}
void fill(plait_lane_grid_params& p, const Shape& shape) {
    plait_grid_params grid{};
    fill(grid, shape);
    p.vertex_stride = shape.vertices;
    p.tile = shape.tile;
    p.edge_count = grid.edge_count;
    p.voxel_edge = grid.voxel_edge;
    std::copy_n(grid.q, 4, p.q);
    std::copy_n(grid.t, 4, p.t);
    p.tent = grid.tent;
    p.diffuse_rule = grid.diffuse_rule;
    p.diffuse_ratio = grid.diffuse_ratio;
    p.diffuse_factor = grid.diffuse_factor;
    p.diffuse_floor = grid.diffuse_floor;
    p.history = 1;
}
void fill(plait_lane_unpack_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, step, 1};
}
void fill(plait_lane_state_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0};
}
void fill(plait_lane_move_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, 3};
}
void fill(plait_lane_fit_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, step};
}
void fill(plait_level_wake_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, 0, 0, step, step};
}
void fill(plait_level_params& p, const Shape& shape) {
    p = {shape.vertices, 0, 0.5f};
}
void fill(plait_lane_orient_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, 0};
}
void fill(plait_lane_history_params& p, const Shape& shape) {
    p = {shape.vertices, shape.tile, shape.vertices, step, 1};
}
void fill(plait_bounds_params& p, const Shape& shape) {
    const auto vertices = static_cast<uint32_t>(shape.total());
    p = {vertices, (vertices - 1) / most_runs + 1, 0};
}
void fill(plait_output_params& p, const Shape& shape) {
    p = {shape.vertices, 0.5f};
}
void fill(plait_tangents_params& p, const Shape& shape) {
    p = {shape.vertices, 0};
}

template <typename Params> std::vector<unsigned char> bytes_of(const Shape& shape) {
    Params params{};
    fill(params, shape);
    std::vector<unsigned char> bytes(sizeof params);
    std::memcpy(bytes.data(), &params, sizeof params);
    return bytes;
}

} // namespace

const Ball& ball() {
    static const Ball made = make_ball(head_radius, 4);
    return made;
}

bool follows_meet_meshes(plait_stage stage) {
    return stage == PLAIT_STAGE_follow_field || stage == PLAIT_STAGE_follow_nearest;
}

bool finds_solids(plait_stage stage) {
    return stage == PLAIT_STAGE_grid_solid_field || stage == PLAIT_STAGE_grid_solid_cross ||
           stage == PLAIT_STAGE_grid_solid_fill;
}

bool finds_planes(plait_stage stage) {
    return stage == PLAIT_STAGE_mesh_field || stage == PLAIT_STAGE_mesh_nearest;
}

std::vector<unsigned char> typical_params(plait_stage stage, const Shape& shape) {
    if (follows_meet_meshes(stage)) { // of one
        plait_follow_collide_params params{};
        fill(params, shape);
        params.collider_count = 1;
        const auto* const bytes = reinterpret_cast<const unsigned char*>(&params);
        return {bytes, bytes + sizeof params};
    }
    if (finds_planes(stage)) { // of one mesh
        plait_lane_params params{};
        fill(params, shape);
        params.collider_count = 1;
        const auto* const bytes = reinterpret_cast<const unsigned char*>(&params);
        return {bytes, bytes + sizeof params};
    }
    switch (stage) {
#define PLAIT_STAGE(name, space, params, summary)                                                  \
    case PLAIT_STAGE_##name:                                                                       \
        return bytes_of<params>(shape);
#include <plait/stages.def>
    default:
        throw std::runtime_error("no such stage");
    }
}

uint32_t item_count(plait_stage stage, const Shape& shape) {
    if (stage == PLAIT_STAGE_contact_pair_scan)
        return 1;
    if (stage == PLAIT_STAGE_bounds) {
        plait_bounds_params params{};
        fill(params, shape);
        return (params.count - 1) / params.share + 1;
    }
    if (stage == PLAIT_STAGE_mesh_take || stage == PLAIT_STAGE_mesh_advance)
        return static_cast<uint32_t>(ball().vertices.size() / 4);
    if (stage == PLAIT_STAGE_mesh_refit)
        return static_cast<uint32_t>(ball().tree.size() / 2);
    if (stage == PLAIT_STAGE_grid_solid_cross)
        return static_cast<uint32_t>(ball().triangle.size() / PLAIT_MESH_TRIANGLE_STRIDE);
    if (finds_solids(stage))
        return grid_edge_count * grid_edge_count;
    switch (plait_stage_describe(stage)->space) {
    case PLAIT_SPACE_VERTEX:
        return static_cast<uint32_t>(shape.total());
    case PLAIT_SPACE_WORD:
        return voxels * slot_capacity;
    case PLAIT_SPACE_VOXEL:
    case PLAIT_SPACE_VOXEL_GROUP:
        return voxels;
    default:
        return shape.strands;
    }
}

uint32_t item_width(plait_stage stage, const Shape& shape) {
    switch (plait_stage_describe(stage)->space) {
    case PLAIT_SPACE_STRAND_GROUP:
    case PLAIT_SPACE_LANES:
        return shape.vertices;
    case PLAIT_SPACE_VOXEL_GROUP:
        return slots_in_parallel;
    default:
        return 1;
    }
}

} // namespace bench
