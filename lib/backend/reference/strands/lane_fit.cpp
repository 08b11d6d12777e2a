// lane_fit: x_before = x - h v of what v belongs to: rows from 1 on are relative to the root, row 0 is
// the root's own.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_fit(uint32_t item_count, const plait_lane_fit_params& params, const lane_fit_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Lane lane(args.lane_slot[2 * item + 1], params.vertex_stride, params.tile);
        const Vec3 root_v = lane.vector(args.lane_v, 0);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const Vec3 v = lane.vector(args.lane_v, i), moved = i == 0 ? v : Vec3(v - root_v);
            lane.store(args.lane_x_before, i,
                       Vec3(lane.vector(args.lane_x, i) - double(params.h) * moved));
            lane.store(args.lane_v_before, i, v);
        }
    }
}

} // namespace plait::reference
