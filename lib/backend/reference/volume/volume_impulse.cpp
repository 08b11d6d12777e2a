// volume_impulse: -grad p/rho at nodes, the mean of the faces before and behind along each axis; that
// of one alone where the other is closed by a collider. Beyond the grid there is no pull. And friction:
// the exchange of momentum over open faces, and the share of a vertex' own velocity that goes.
#include "backend/reference/grid/volume.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <cmath>

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

// Of a difference of velocities, by an implicit step; `pull`: m/s^2, of the pressure.
double friction(const plait_volume_impulse_params& params, double pull) {
    const double pressed = std::min(1.0, std::abs(pull) / PLAIT_VOLUME_WEIGHT);
    const double rate = params.viscosity * (1 + PLAIT_VOLUME_FRICTION * pressed);
    return 1 - 1 / (1 + params.h * rate);
}

// m/s: a node's share of the momenta that it exchanges with those around it, a sixth of what would
// make both as fast, times the friction at the face.
Vec4 exchanged(const plait_volume_impulse_params& params, const volume_impulse_args& args,
               const NodeGrid& grid, size_t node) {
    Vec4 sum = Vec4::Zero();
    for (size_t axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
            const auto other = grid.neighbour(node, axis, side);
            const double link = other ? link_between(args.volume_link, node, *other, axis) : 0.0;
            const double own = args.grid_density[node];
            const double there = other ? args.grid_density[*other] : 0.0;
            if (link <= 0 || own + there <= 0)
                continue;
            const double pull = link / double(params.voxel_edge) *
                                (args.volume_pressure[*other] - args.volume_pressure[node]);
            sum += friction(params, pull) / 6 * there / (own + there) *
                   (args.grid_velocity[*other] - args.grid_velocity[node]);
        }
    return sum;
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
        const double share = friction(params, push.norm());
        change += exchanged(params, args, grid, node) + share * args.grid_velocity[node];
        change[3] = share;
        const double density = args.grid_density[node];
        args.volume_potential[2 * node] = density > 0 ? args.volume_pressure[node] / density : 0;
        args.volume_potential[2 * node + 1] = density;
        args.volume_pull[2 * node] = change;
        args.volume_pull[2 * node + 1] = push;
    }
}

} // namespace plait::reference
