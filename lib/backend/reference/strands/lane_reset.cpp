// lane_reset: the rest shape under the root pose, at rest; orientations accumulate the rest
// rotations of the joints from the root frame on.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_reset(uint32_t item_count, const plait_lane_state_params& params,
                const lane_reset_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Pose pose = pose_of(args.pose, strand);
        const Vec3 origin = xyz(args.rest[strand * params.row_stride]);
        Quat q = pose.q;
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const Vec3 p = xyz(args.rest[strand * params.row_stride + i]);
            const Vec3 x = i == 0 ? pose.apply(p) : Vec3(pose.q * (p - origin));
            lane.store(args.lane_x, i, x);
            lane.store(args.lane_v, i, Vec3(Vec3::Zero()));
            args.lane_normal_force[lane.index(i, 0, 1)] = 0;
            if (params.history) {
                lane.store(args.lane_x_before, i, x);
                lane.store(args.lane_v_before, i, Vec3(Vec3::Zero()));
            }
            q = q * lane.rotation(args.lane_rest, i);
            lane.store(args.lane_q, i, q);
            lane.store(args.lane_q_before, i, q);
        }
    }
}

} // namespace plait::reference
