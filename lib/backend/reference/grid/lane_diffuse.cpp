// lane_diffuse: the rule of grid_diffuse on velocities where the lanes keep them.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/grid/grid.hpp"

namespace plait::reference {

void lane_diffuse(uint32_t item_count, const plait_lane_grid_params& params,
                  const lane_diffuse_args& args) {
    const Grid grid(params);
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Vec3 root = lane.vector(args.lane_x, 0);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (size_t i = 1; i < count; ++i) {
            const Vec3 before = lane.vector(args.lane_v, i), v = grid.components(before);
            const Vec3 slower = diffused(grid, params, root + lane.vector(args.lane_x, i), v,
                                         args.grid_density, args.grid_velocity);
            const Vec3 gained = grid.to_world(slower - v);
            lane.store(args.lane_v, i, Vec3(before + gained));
            if (params.history)
                lane.store(args.lane_v_before, i,
                           Vec3(lane.vector(args.lane_v_before, i) + gained));
        }
    }
}

} // namespace plait::reference
