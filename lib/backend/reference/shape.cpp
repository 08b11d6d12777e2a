#include "backend/reference/shape.hpp"

#include "backend/reference/view.hpp"

#include <cstring>

namespace plait::reference {
namespace {

void check_range(const char* name, size_t value, size_t low, size_t high) {
    if (value < low || value > high)
        throw BadDispatch(format("%s is %zu, allowed %zu..%zu", name, value, low, high));
}

constexpr size_t max_voxels_per_edge = 64;
constexpr size_t max_capacity = 65536;
constexpr size_t max_tile = 1024;

} // namespace

void Shape::check_positive(const char* name, double value) {
    if (!(value > 0))
        throw BadDispatch(format("%s is %g, allowed > 0", name, value));
}

void Shape::set_stride(uint32_t vertex_stride) {
    check_range("vertex_stride", vertex_stride, PLAIT_MIN_VERTICES, PLAIT_MAX_VERTICES);
    stride_ = vertex_stride;
}

void Shape::set_grid(uint32_t edge_count, double voxel_edge) {
    check_range("edge_count", edge_count, 1, max_voxels_per_edge);
    check_positive("voxel_edge", voxel_edge);
    voxels_ = size_t{edge_count} * edge_count * edge_count;
}

void Shape::set_capacity(uint32_t capacity) {
    check_range("capacity", capacity, 1, max_capacity);
    capacity_ = capacity;
}

void Shape::set_rows(plait_space space) {
    if (space == PLAIT_SPACE_VERTEX) {
        vertices_ = items_;
        strands_ = (items_ + stride_ - 1) / stride_;
    } else if (space == PLAIT_SPACE_STRAND || space == PLAIT_SPACE_STRAND_GROUP ||
               space == PLAIT_SPACE_LANES) {
        strands_ = items_;
        vertices_ = items_ * stride_;
    }
}

// The items of follow are the followers' vertices; everything else it reads belongs to the guides.
void Shape::set_guides(size_t guides) {
    followers_ = strands_;
    strands_ = guides;
    vertices_ = guides * stride_;
}

void Shape::set_tiles(size_t tile) {
    check_range("tile", tile, 1, max_tile);
    tiled_vertices_ = (strands_ + tile - 1) / tile * tile * stride_;
}

void Shape::check_items(const plait_dispatch& dispatch, plait_space space) const {
    const uint32_t width = dispatch.item_width;
    if (space == PLAIT_SPACE_STRAND_GROUP || space == PLAIT_SPACE_LANES)
        check_range("item_width", width, stride_, stride_);
    else if (space == PLAIT_SPACE_VOXEL_GROUP)
        check_range("item_width", width, 1, max_capacity);
    else
        check_range("item_width", width, 1, 1);
    if (space == PLAIT_SPACE_VOXEL || space == PLAIT_SPACE_VOXEL_GROUP)
        check_range("item_count", items_, 0, voxels_);
}

size_t Shape::elements(const char* argument) const {
    const auto is = [argument](auto... names) {
        return ((std::strcmp(argument, names) == 0) || ...);
    };
    if (is("position"))
        return vertices_ + followers_ * stride_;
    if (is("rest", "rest_length", "position_prev", "position_prev2", "position_local",
           "position_out", "position_last_frame", "tangent"))
        return vertices_;
    if (is("acceleration"))
        return accelerates_ ? vertices_ : 0;
    if (is("lane_acceleration"))
        return accelerates_ ? tiled_vertices_ * 3 : 0;
    if (is("vertex_count", "strand_stats"))
        return strands_;
    if (is("pose", "pose_from", "pose_to", "pose_now"))
        return strands_ * PLAIT_POSE_STRIDE;
    if (is("root_from", "root_to"))
        return per_root_ ? strands_ * PLAIT_POSE_STRIDE : 0;
    if (is("strand_motion"))
        return strands_ * PLAIT_MOTION_STRIDE;
    if (is("capsule"))
        return colliders_ * PLAIT_COLLIDER_STRIDE;
    if (is("follow_guide", "follow_offset"))
        return followers_;
    if (is("lane_x", "lane_v"))
        return tiled_vertices_ * 3;
    if (is("lane_x_before", "lane_v_before"))
        return history_ ? tiled_vertices_ * 3 : 0;
    if (is("lane_q", "lane_q_before", "lane_rest"))
        return tiled_vertices_ * 4;
    if (is("lane_material"))
        return tiled_vertices_ * PLAIT_LANE_MATERIAL_COMPONENTS;
    if (is("lane_slot"))
        return 2 * items_;
    if (is("bone_index", "bone_weight"))
        return 4 * strands_;
    if (is("points"))
        return points_;
    if (is("box"))
        return 2 * items_;
    if (is("lane_strand", "lane_from", "lane_to", "bone_matrix"))
        return 0;
    if (is("words"))
        return items_;
    if (is("grid_slot"))
        return voxels_ * capacity_;
    if (is("grid_density", "grid_velocity"))
        return voxels_;
    if (is("grid_sum"))
        return voxels_ * PLAIT_SUM_STRIDE;
    if (is("grid_outside"))
        return 1;
    throw BadDispatch(format("%s: an argument of no known size", argument));
}

} // namespace plait::reference
