#include "backend/reference/base/shape.hpp"

#include "backend/reference/base/view.hpp"

namespace plait::reference {
namespace {

void check_range(const char* name, size_t value, size_t low, size_t high) {
    if (value < low || value > high)
        throw BadDispatch(format("%s is %zu, allowed %zu..%zu", name, value, low, high));
}

size_t needed(bool read, size_t extent) {
    return read ? extent : 0;
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
    stride_ = row_stride_ = vertex_stride;
}

void Shape::set_row_stride(uint32_t row_stride) {
    check_range("row_stride", row_stride, stride_, PLAIT_MAX_VERTICES);
    row_stride_ = row_stride;
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
        strands_ = (items_ + stride_ - 1) / stride_;
        vertices_ = row_stride_ == stride_ ? items_ : strands_ * row_stride_;
    } else if (space == PLAIT_SPACE_STRAND || space == PLAIT_SPACE_STRAND_GROUP ||
               space == PLAIT_SPACE_LANES) {
        strands_ = items_;
        vertices_ = items_ * row_stride_;
    }
}

// The items of tressfx_follow are the followers' vertices, those of follow_turns, follow_clump
// and follow_curl the followers; what else they read belongs to the guides.
void Shape::set_guides(size_t guides) {
    followers_ = strands_;
    strands_ = guides;
    vertices_ = guides * stride_;
}

void Shape::set_first(size_t strand) {
    strands_ += strand;
    vertices_ += strand * stride_;
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

// The names are those in which buffers.def is written.
size_t Shape::elements(BufferName buffer) const {
    constexpr bool ALWAYS = true;
    const bool PER_ROOT = per_root_, BENDS = bends_, HISTORY = history_, ACCELERATES = accelerates_,
               PINS = pins_, FIELD = field_, PLANES = planes_, HOLLOWS = hollows_,
               PRESSURE = pressure_, CARRIED = carried_, WET = wet_, SHOWN = shown_,
               MESHES = meshes_;
    const size_t ITEMS = items_, STRANDS = strands_, VERTICES = vertices_, TILED = tiled_vertices_,
                 FOLLOWERS = followers_, ROW = stride_, COLLIDERS = colliders_, VOXELS = voxels_,
                 SLOTS = capacity_, POINTS = points_;
    switch (buffer) {
#define PLAIT_BUFFER(name, when, extent, components)                                               \
    case BufferName::name:                                                                         \
        return needed(when, extent);
#include <plait/buffers.def>
    }
    return 0;
}

} // namespace plait::reference
