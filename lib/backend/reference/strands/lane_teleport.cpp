// lane_teleport: the rigid motion pose_to * pose_from^-1 applied to positions, velocities and
// orientations; offsets from the root only turn, and the root, row 0, goes where pose_to puts it, its
// place a substep ago as far from there as before.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_teleport(uint32_t item_count, const plait_lane_state_params& params,
                   const lane_teleport_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Pose to = pose_of(args.pose_to, strand);
        const Vec3 root = root_of(args.rest, to, strand, params.row_stride);
        const Quat turn = to.q * pose_of(args.pose_from, strand).q.conjugate();
        const auto carry = [&](const View<double>& x, const View<double>& v, uint32_t i,
                               const Vec3& to_root) {
            lane.store(x, i, i == 0 ? to_root : Vec3(turn * lane.vector(x, i)));
            lane.store(v, i, Vec3(turn * lane.vector(v, i)));
        };
        const Vec3 before = params.history
                                ? Vec3(root + turn * (lane.vector(args.lane_x_before, 0) -
                                                      lane.vector(args.lane_x, 0)))
                                : root;
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            carry(args.lane_x, args.lane_v, i, root);
            if (params.history)
                carry(args.lane_x_before, args.lane_v_before, i, before);
            args.lane_normal_force[lane.index(i, 0, 1)] = 0;
            lane.store(args.lane_q, i, turn * lane.rotation(args.lane_q, i));
            lane.store(args.lane_q_before, i, turn * lane.rotation(args.lane_q_before, i));
        }
    }
}

} // namespace plait::reference
