#include "backend/reference/grid/grid.hpp"

namespace plait::reference {

Grid::Grid(const plait_grid_params& params)
    : pose_{quat(params.q), vec3(params.t)}, voxel_edge_(params.voxel_edge), h_(params.h),
      edge_count_(static_cast<int>(params.edge_count)), tent_(params.tent) {}

Grid::Grid(const plait_lane_grid_params& params)
    : pose_{quat(params.q), vec3(params.t)}, voxel_edge_(params.voxel_edge), h_(0),
      edge_count_(static_cast<int>(params.edge_count)), tent_(params.tent) {}

Grid::Grid(const plait_lane_volume_params& params)
    : pose_{quat(params.q), vec3(params.t)}, voxel_edge_(params.voxel_edge), h_(0),
      edge_count_(static_cast<int>(params.edge_count)), tent_(PLAIT_TENT_TRILINEAR) {}

Vec3 Grid::coordinates(const Vec3& x) const {
    return pose_.invert(x) / voxel_edge_;
}

size_t Grid::index(const Eigen::Array3i& cell) const {
    const auto nv = static_cast<size_t>(edge_count_);
    return static_cast<size_t>(cell.y()) * nv * nv + static_cast<size_t>(cell.z()) * nv +
           static_cast<size_t>(cell.x());
}

bool Grid::inside(const Eigen::Array3i& cell) const {
    return (cell >= 0).all() && (cell < edge_count_).all();
}

std::optional<size_t> Grid::voxel_at(const Vec3& p) const {
    // Compared before the conversion: NaN and huge coordinates are outside too.
    if (!((p.array() >= 0).all() && (p.array() < edge_count_).all()))
        return std::nullopt;
    return index(p.array().floor().cast<int>());
}

double Grid::voxel_tent(const Vec3& p) {
    const Eigen::Array3d from_centre = p.array() - p.array().floor() - 0.5;
    return (1 - (2 * from_centre).abs()).prod();
}

Grid::Nodes Grid::nodes(const Vec3& p) const {
    Nodes result;
    const auto voxel = voxel_at(p);
    if (!voxel)
        return result;
    if (tent_ == PLAIT_TENT_VOXEL) {
        result.node[result.count++] = {*voxel, voxel_tent(p)};
        return result;
    }
    // Nodes sit at voxel centres.
    const Eigen::Array3d from_node = (p.array() - 0.5).max(0).min(edge_count_ - 1);
    const Eigen::Array3d base = from_node.floor();
    const Eigen::Array3d f = from_node - base;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Array3i step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const Eigen::Array3i cell = base.cast<int>() + step;
        if (inside(cell)) // beyond the rim the weight is 0
            result.node[result.count++] = {index(cell), (step == 1).select(f, 1 - f).prod()};
    }
    return result;
}

Vec3 Grid::velocity(const Vec4& position, const Vec4& position_prev) const {
    return components(xyz(position) - xyz(position_prev)) / h_;
}

} // namespace plait::reference
