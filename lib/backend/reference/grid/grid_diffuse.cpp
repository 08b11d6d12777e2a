// grid_diffuse: brake vertices that outrun the hair around them, per component in the grid's frame.
//   |v_c| > ratio ref_c  =>  v_c *= factor,   written as position_prev = position - v' h
// Thesis: ref_c = |mean_c|, which brakes everything where the mean is near zero. Ours:
// ref_c = max(|mean_c|, floor rms). With PLAIT_TENT_TRILINEAR mean and rms^2 are gathered from the
// nodes around the vertex with weights of the tent, the transpose of the splat, so that splat and
// gather keep momentum. After grid_splat none of them is empty, since the vertex itself was
// splatted to each; after the slot stages one may be, and counts as hair at rest. With
// PLAIT_TENT_VOXEL they are those of its voxel. Source: Ugurca 2015, sections 4.3 and 4.4.
#include "backend/reference/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plait::reference {
namespace {

// Mean velocity and rms speed of the hair at grid coordinates p; none where there is none.
std::optional<Vec4> surroundings(const Grid& grid, const Vec3& p,
                                 const View<const double>& grid_density,
                                 const View<const Vec4>& grid_velocity) {
    const Grid::Nodes nodes = grid.nodes(p);
    if (nodes.count == 1) { // its weight says nothing, not even where it is 0
        const size_t voxel = nodes.node[0].voxel;
        return grid_density[voxel] > 0 ? std::optional(grid_velocity[voxel]) : std::nullopt;
    }
    Vec3 mean = Vec3::Zero();
    double mean_square = 0, density = 0;
    for (size_t n = 0; n < nodes.count; ++n) {
        const Node& node = nodes.node[n];
        const Vec4& node_velocity = grid_velocity[node.voxel];
        mean += node.weight * xyz(node_velocity);
        mean_square += node.weight * node_velocity.w() * node_velocity.w();
        density += node.weight * grid_density[node.voxel];
    }
    if (!(density > 0))
        return std::nullopt;
    return with_w(mean, std::sqrt(mean_square));
}

} // namespace

template <typename Params>
Vec3 diffused(const Grid& grid, const Params& params, const Vec3& x, const Vec3& v,
              const View<const double>& grid_density, const View<const Vec4>& grid_velocity) {
    const auto around = surroundings(grid, grid.coordinates(x), grid_density, grid_velocity);
    if (!around)
        return v;
    Vec3 result = v;
    for (int c = 0; c < 3; ++c) {
        double reference = std::abs((*around)[c]);
        if (params.diffuse_rule == PLAIT_DIFFUSE_FLOORED)
            reference = std::max(reference, params.diffuse_floor * around->w());
        if (std::abs(v[c]) > params.diffuse_ratio * reference)
            result[c] *= params.diffuse_factor;
    }
    return result;
}

template Vec3 diffused(const Grid&, const plait_grid_params&, const Vec3&, const Vec3&,
                       const View<const double>&, const View<const Vec4>&);
template Vec3 diffused(const Grid&, const plait_lane_grid_params&, const Vec3&, const Vec3&,
                       const View<const double>&, const View<const Vec4>&);

void grid_diffuse(uint32_t item_count, const plait_grid_params& params,
                  const grid_diffuse_args& args) {
    const Grid grid(params);
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const Vec4& x = args.position[item];
        if (i >= count || pinned(x))
            continue;
        const Vec3 v = grid.velocity(x, args.position_prev[item]);
        const Vec3 slower =
            diffused(grid, params, xyz(x), v, args.grid_density, args.grid_velocity);
        if (slower != v)
            set_xyz(args.position_prev[item], xyz(x) - grid.to_world(slower) * params.h);
    }
}

} // namespace plait::reference
