// lane_splat: the sums of grid_splat over strands in lanes, whose velocities are kept.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/grid/grid.hpp"

namespace plait::reference {

void lane_splat(uint32_t item_count, const plait_lane_grid_params& params,
                const lane_splat_args& args) {
    const Grid grid(params);
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Vec3 root = lane.vector(args.lane_x, 0);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (size_t i = 0; i < count; ++i) {
            const Vec3 x = i > 0 ? Vec3(root + lane.vector(args.lane_x, i)) : root;
            add_to_sums(grid, x, grid.components(lane.vector(args.lane_v, i)), args.grid_sum,
                        args.grid_outside);
        }
    }
}

} // namespace plait::reference
