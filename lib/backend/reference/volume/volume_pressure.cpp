// volume_pressure: p <- max(least, p - omega residual/diagonal) at nodes of one colour.
#include "backend/reference/grid/volume.hpp"

#include <algorithm>

namespace plait::reference {

void volume_pressure(uint32_t item_count, const plait_volume_sweep_params& params,
                     const volume_pressure_args& args) {
    const NodeGrid grid(params.edge_count);
    const size_t n = params.edge_count, half_row = (n + 1) / 2;
    for (size_t item = 0; item < item_count; ++item) {
        const size_t row = item / half_row, y = row / n, z = row % n;
        const size_t x = 2 * (item % half_row) + (y + z + params.colour) % 2;
        if (y >= n || x >= n)
            continue;
        const size_t node = grid.index({x, y, z});
        const Vec4& equation = args.volume_node[node];
        if (equation.z() <= 0)
            continue;
        double& pressure = args.volume_pressure[node];
        double residual = equation.x();
        for (size_t axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1})
                if (const auto other = grid.neighbour(node, axis, side))
                    residual += link_between(args.volume_link, node, *other, axis) *
                                (pressure - args.volume_pressure[*other]);
        pressure = std::max(equation.y(), pressure - equation.z() * residual);
    }
}

} // namespace plait::reference
