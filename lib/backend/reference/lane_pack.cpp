// lane_pack: the inverse of lane_unpack for every vertex but the root.
#include "backend/reference/lanes.hpp"

namespace plait::reference {

void lane_pack(uint32_t item_count, const plait_lane_layout_params& params,
               const lane_pack_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [slot, i] = place(item, params.vertex_stride);
        const size_t strand = strand_of(args.lane_strand, slot);
        if (i == 0 || i >= vertices_of(args.vertex_count, strand, params.vertex_stride))
            continue;
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t vertex = strand * params.vertex_stride + i;
        const Vec3 root = xyz(args.position[vertex - i]), x = xyz(args.position[vertex]);
        lane.store(args.lane_x, i, Vec3(x - root));
        lane.store(args.lane_v, i, Vec3((x - xyz(args.position_prev[vertex])) / params.h));
    }
}

} // namespace plait::reference
