// grid_splat: exact sums of tent, tent v and tent |v|^2 over all vertices, not a sample of them.
// Every addend is rounded once (to nearest even) to fixed point; integer addition is associative,
// so any order of the vertices gives the same bits.
#include "backend/reference/grid/grid.hpp"
#include "backend/reference/grid/grid_sum.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

int64_t fixed_point(double value, double scale) {
    return static_cast<int64_t>(std::nearbyint(value * scale));
}

Vec3 limit_speed(const Vec3& v) {
    const double limit = PLAIT_SUM_MAX_SPEED;
    return v.cwiseMax(-limit).cwiseMin(limit);
}

void add_vertex(const View<uint32_t>& words, const Node& node, const Vec3& v) {
    const size_t first = node.voxel * PLAIT_SUM_STRIDE;
    const double w = node.weight;
    add_to_sum(words, first, fixed_point(w, PLAIT_SUM_DENSITY_SCALE));
    for (int c = 0; c < 3; ++c)
        add_to_sum(words, first + 2 + 2 * static_cast<size_t>(c),
                   fixed_point(w * v[c], PLAIT_SUM_MOMENTUM_SCALE));
    add_to_sum(words, first + 8, fixed_point(w * v.squaredNorm(), PLAIT_SUM_ENERGY_SCALE));
}

} // namespace

void add_to_sums(const Grid& grid, const Vec3& x, const Vec3& v, const View<uint32_t>& grid_sum,
                 const View<uint32_t>& grid_outside) {
    const Vec3 p = grid.coordinates(x);
    if (!grid.voxel_at(p)) {
        ++grid_outside[0];
        return;
    }
    const Grid::Nodes nodes = grid.nodes(p);
    for (size_t n = 0; n < nodes.count; ++n)
        add_vertex(grid_sum, nodes.node[n], limit_speed(v));
}

void grid_splat(uint32_t item_count, const plait_grid_params& params, const grid_splat_args& args) {
    const Grid grid(params);
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t first = strand * params.vertex_stride;
        const size_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (size_t item = first; item < first + count; ++item)
            add_to_sums(grid, xyz(args.position[item]),
                        grid.velocity(args.position[item], args.position_prev[item]), args.grid_sum,
                        args.grid_outside);
    }
}

} // namespace plait::reference
