// volume_impulse: -grad p/rho at nodes, the mean of the faces before and behind along each axis; that
// of one alone where the other is closed by a collider. Beyond the grid there is no pull.
#include "backend/reference/volume.hpp"

namespace plait::reference {
namespace {

struct Pull {
    double before = 0, now = 0; // m/s^2, by the pressures of both steps
};

Pull pull_of(const plait_volume_impulse_params& params, const volume_impulse_args& args,
             const NodeGrid& grid, size_t node, size_t axis) {
    Pull sum;
    double faces = 0;
    for (const int side : {-1, 1}) {
        const auto other = grid.neighbour(node, axis, side);
        if (!other) {
            faces += 1;
            continue;
        }
        const double link = link_between(args.volume_link, node, *other, axis);
        if (link <= 0)
            continue;
        faces += 1;
        const double scale = -side * link / double(params.voxel_edge);
        sum.now += scale * (args.volume_pressure[*other] - args.volume_pressure[node]);
        sum.before += scale * (args.volume_link[*other][3] - args.volume_link[node][3]);
    }
    if (faces > 0)
        return {sum.before / faces, sum.now / faces};
    return {};
}

} // namespace

void volume_impulse(uint32_t item_count, const plait_volume_impulse_params& params,
                    const volume_impulse_args& args) {
    const NodeGrid grid(params.edge_count);
    for (size_t node = 0; node < item_count; ++node) {
        Vec4 change = Vec4::Zero(), push = Vec4::Zero();
        for (size_t axis = 0; axis < 3; ++axis) {
            const Pull pull = pull_of(params, args, grid, node, axis);
            change[static_cast<Eigen::Index>(axis)] = double(params.h) * (pull.now - pull.before);
            push[static_cast<Eigen::Index>(axis)] = pull.now;
        }
        change += double(params.blend) * args.grid_velocity[node];
        change[3] = 0;
        const double density = args.grid_density[node];
        args.volume_potential[2 * node] = density > 0 ? args.volume_pressure[node] / density : 0;
        args.volume_potential[2 * node + 1] = density;
        args.volume_pull[2 * node] = change;
        args.volume_pull[2 * node + 1] = push;
    }
}

} // namespace plait::reference
