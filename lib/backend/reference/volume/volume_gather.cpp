// volume_gather: a vertex takes the change at the nodes around it, and of their velocity, which is in
// it, a share in place of its own.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/grid/grid.hpp"

namespace plait::reference {

void volume_gather(uint32_t item_count, const plait_lane_volume_params& params,
                   const volume_gather_args& args) {
    const Grid grid(params);
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Vec3 root = lane.vector(args.lane_x, 0);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (size_t i = 0; i < params.vertex_stride; ++i)
            lane.store(args.lane_pressure, i, Vec3(Vec3::Zero()));
        for (size_t i = 1; i < count; ++i) {
            const auto nodes = grid.nodes(grid.coordinates(root + lane.vector(args.lane_x, i)));
            if (nodes.count == 0)
                continue;
            Vec3 change = Vec3::Zero(), push = Vec3::Zero();
            double share = 0;
            for (size_t k = 0; k < nodes.count; ++k) {
                const auto [node, weight] = nodes.node[k];
                change += weight * xyz(args.volume_pull[2 * node]);
                share += weight * args.volume_pull[2 * node].w();
                push += weight * xyz(args.volume_pull[2 * node + 1]);
            }
            lane.store(args.lane_pressure, i, grid.to_world(push));
            if (!params.moves)
                continue;
            const Vec3 v = lane.vector(args.lane_v, i);
            const Vec3 gained = grid.to_world(change) - share * v;
            lane.store(args.lane_v, i, Vec3(v + gained));
            if (params.history)
                lane.store(args.lane_v_before, i,
                           Vec3(lane.vector(args.lane_v_before, i) + gained));
        }
    }
}

} // namespace plait::reference
