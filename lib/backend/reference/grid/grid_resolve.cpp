// grid_resolve: the fixed-point sums of grid_splat as density, mean velocity and rms speed, in the
// form grid_velocity leaves them in.
#include "backend/reference/base/stages.hpp"
#include "backend/reference/grid/grid_sum.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {

void grid_resolve(uint32_t item_count, const plait_grid_params&, const grid_resolve_args& args) {
    for (size_t voxel = 0; voxel < item_count; ++voxel) {
        const auto sum = [&](size_t which) {
            return static_cast<double>(
                load_sum(args.grid_sum, voxel * PLAIT_SUM_STRIDE + 2 * which));
        };
        const double density = sum(0) / PLAIT_SUM_DENSITY_SCALE;
        const Vec3 momentum = Vec3(sum(1), sum(2), sum(3)) / PLAIT_SUM_MOMENTUM_SCALE;
        const double energy = sum(4) / PLAIT_SUM_ENERGY_SCALE;
        args.grid_density[voxel] = density;
        args.grid_velocity[voxel] =
            density > 0 ? with_w(momentum / density, std::sqrt(std::max(0.0, energy / density)))
                        : Vec4(Vec4::Zero());
    }
}

} // namespace plait::reference
