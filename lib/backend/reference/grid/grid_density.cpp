// grid_density: D = sum of the tents of the vertices in the voxel's slots.
// Source: Ugurca 2015, equation 4.1.
#include "backend/reference/grid/grid.hpp"

namespace plait::reference {

void grid_density(uint32_t item_count, const plait_grid_params& params,
                  const grid_density_args& args) {
    const Grid grid(params);
    for (size_t voxel = 0; voxel < item_count; ++voxel) {
        double density = 0;
        for (size_t slot = 0; slot < params.capacity; ++slot) {
            const uint32_t vertex = args.grid_slot[voxel * params.capacity + slot];
            if (vertex != PLAIT_SLOT_EMPTY)
                density += Grid::voxel_tent(grid.coordinates(xyz(args.position[vertex])));
        }
        args.grid_density[voxel] = density;
    }
}

} // namespace plait::reference
