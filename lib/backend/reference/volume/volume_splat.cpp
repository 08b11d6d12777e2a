// volume_splat: what grid_splat sums up, of vertices that stand for different amounts of hair, and
// instead of the energy the density at rest; of wet hair 1 + 2 w times as much, or w itself.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/grid/grid.hpp"
#include "backend/reference/grid/grid_sum.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

int64_t rounded(double value, double scale) {
    return static_cast<int64_t>(std::nearbyint(value * scale));
}

void add(const View<uint32_t>& sums, const Node& node, double hair, const Vec3& v, double rest) {
    const size_t first = node.voxel * PLAIT_SUM_STRIDE;
    const double mass = node.weight * hair;
    add_to_sum(sums, first, rounded(mass, PLAIT_SUM_DENSITY_SCALE));
    for (size_t axis = 0; axis < 3; ++axis)
        add_to_sum(sums, first + 2 + 2 * axis,
                   rounded(mass * v[static_cast<Eigen::Index>(axis)], PLAIT_SUM_MOMENTUM_SCALE));
    add_to_sum(sums, first + 8, rounded(mass * rest, PLAIT_SUM_REST_SCALE));
}

Vec3 limited(Vec3 v) {
    const double most = PLAIT_SUM_MAX_SPEED;
    for (double& component : v)
        component = std::isnan(component) ? 0 : std::clamp(component, -most, most);
    return v;
}

} // namespace

void volume_splat(uint32_t item_count, const plait_lane_volume_params& params,
                  const volume_splat_args& args) {
    const Grid grid(params);
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Vec3 root = lane.vector(args.lane_x, 0);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const auto share = [&](size_t i, size_t component) {
            return args.lane_share[lane.index(i, component, PLAIT_LANE_SHARE_COMPONENTS)];
        };
        const double wetness = params.wet ? args.strand_wetness[strand] : 0;
        const auto fifth = [&](size_t i) {
            return params.wet && params.soaked
                       ? wetness
                       : share(i, PLAIT_LANE_SHARE_REST) * (1 + PLAIT_WET_CLOSENESS * wetness);
        };
        for (size_t i = 0; i < count; ++i) {
            const Vec3 x = i > 0 ? Vec3(root + lane.vector(args.lane_x, i)) : root;
            const auto nodes = grid.nodes(grid.coordinates(x));
            if (nodes.count == 0)
                ++args.grid_outside[0];
            const Vec3 v = limited(grid.components(lane.vector(args.lane_v, i)));
            for (size_t node = 0; node < nodes.count; ++node)
                add(args.grid_sum, nodes.node[node], share(i, PLAIT_LANE_SHARE_HAIR), v, fifth(i));
        }
    }
}

} // namespace plait::reference
