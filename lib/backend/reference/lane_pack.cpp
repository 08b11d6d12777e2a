// lane_pack: the inverse of lane_unpack for every vertex but the root.
#include "backend/reference/lanes.hpp"

namespace plait::reference {

void lane_pack(uint32_t item_count, const plait_lane_history_params& params,
               const lane_pack_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [slot, i] = strand_vertex(item, params.vertex_stride);
        const size_t strand = strand_of(args.lane_strand, slot);
        if (i == 0 || i >= vertices_of(args.vertex_count, strand, params.vertex_stride))
            continue;
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t vertex = strand * params.row_stride + i;
        const Vec3 root = xyz(args.position[vertex - i]), x = xyz(args.position[vertex]);
        lane.store(args.lane_x, i, Vec3(x - root));
        const Vec3 v = (x - xyz(args.position_prev[vertex])) / params.h;
        const Vec3 gained = v - lane.vector(args.lane_v, i);
        if (params.history)
            lane.store(args.lane_v_before, i, Vec3(lane.vector(args.lane_v_before, i) + gained));
        lane.store(args.lane_v, i, v);
    }
}

} // namespace plait::reference
