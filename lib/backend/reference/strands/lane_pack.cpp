// lane_pack: the inverse of lane_unpack for every vertex but the root, where that is not as it was.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

// As a caller sees them.
bool same_floats(const Vec3& a, const Vec3& b) {
    return a.cast<float>() == b.cast<float>();
}

} // namespace

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
        const Vec3 offset = lane.vector(args.lane_x, i), was = lane.vector(args.lane_v, i);
        const Vec3 shown = root + offset, prev = xyz(args.position_prev[vertex]);
        if (!same_floats(shown, x)) {
            lane.store(args.lane_x, i, Vec3(x - root));
            args.lane_normal_force[lane.index(i, 0, 1)] = 0;
            if (params.history)
                lane.store(args.lane_x_before, i,
                           Vec3(lane.vector(args.lane_x_before, i) + x - shown));
        } else if (same_floats(shown - params.h * was, prev)) {
            continue;
        }
        const Vec3 v = (x - prev) / params.h;
        const Vec3 gained = v - was;
        if (params.history)
            lane.store(args.lane_v_before, i, Vec3(lane.vector(args.lane_v_before, i) + gained));
        if (params.history == 2)
            lane.store(args.lane_x_before, i,
                       Vec3(lane.vector(args.lane_x_before, i) - params.h * gained));
        lane.store(args.lane_v, i, v);
    }
}

} // namespace plait::reference
