// grid_velocity: V = sum(tent v) / D over the vertices in the voxel's slots, and beside it the rms
// speed sqrt(sum(tent |v|^2) / D), which grid_diffuse takes as a floor.
// Source: Ugurca 2015, equation 4.2; the rms speed is ours.
#include "backend/reference/grid/grid.hpp"

#include <cmath>

namespace plait::reference {

void grid_velocity(uint32_t item_count, const plait_grid_params& params,
                   const grid_velocity_args& args) {
    const Grid grid(params);
    for (size_t voxel = 0; voxel < item_count; ++voxel) {
        Vec4 sum = Vec4::Zero(); // tent v, tent |v|^2
        for (size_t slot = 0; slot < params.capacity; ++slot) {
            const uint32_t vertex = args.grid_slot[voxel * params.capacity + slot];
            if (vertex == PLAIT_SLOT_EMPTY)
                continue;
            const Vec4& x = args.position[vertex];
            const Vec3 v = grid.velocity(x, args.position_prev[vertex]);
            sum += Grid::voxel_tent(grid.coordinates(xyz(x))) * with_w(v, v.squaredNorm());
        }
        const double density = args.grid_density[voxel];
        if (density > 0)
            sum /= density;
        args.grid_velocity[voxel] =
            density > 0 ? with_w(xyz(sum), std::sqrt(sum.w())) : Vec4(Vec4::Zero());
    }
}

} // namespace plait::reference
