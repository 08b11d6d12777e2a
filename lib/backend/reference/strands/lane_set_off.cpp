// lane_set_off: strands keep their motion relative to the head, of whose own the part that was, M from
// pose_before to pose_was, carried to pose, gives way to N from pose to pose_next.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/strands/set_off.hpp"

namespace plait::reference {
namespace {

// m/s: as the integrator differences places, one and two substeps ago.
Vec3 velocity(const RigidMotion& motion, const Vec3& x, double h, bool bdf2) {
    const Vec3 first = motion.undo(x);
    if (!bdf2)
        return (x - first) / h;
    return (3 * x - 4 * first + motion.undo(first)) / (2 * h);
}

} // namespace

void lane_set_off(uint32_t item_count, const plait_set_off_params& params,
                  const lane_set_off_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const Lane lane(slot, params.vertex_stride, params.tile);
        const size_t strand = strand_of(args.lane_strand, slot);
        const Pose now = pose_of(args.pose, strand);
        const Pose before =
            carried(pose_of(args.pose_before, strand), pose_of(args.pose_was, strand), now);
        const RigidMotion was(before, now), is(now, pose_of(args.pose_next, strand));
        const Vec3 root = root_of(args.rest, now, strand, params.row_stride);
        if (!sets_off(was, is, root, params))
            continue;
        const Quat change = is.turn().conjugate() * was.turn();
        const Vec3 root_was = was.undo(root), root_is = is.undo(root); // a substep ago
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            const bool pairs = params.history && i > 0;
            const Vec3 x = i == 0 ? root : Vec3(root + lane.vector(args.lane_x, i));
            lane.store(args.lane_v, i,
                       Vec3(lane.vector(args.lane_v, i) + velocity(is, x, params.h, pairs) -
                            velocity(was, x, params.h, pairs)));
            lane.store(args.lane_q_before, i, change * lane.rotation(args.lane_q_before, i));
            if (!params.history)
                continue;
            if (i == 0) { // its path need not be straight
                lane.store(args.lane_x_before, 0,
                           Vec3(lane.vector(args.lane_x_before, 0) + (root_is - root_was)));
                continue;
            }
            const Vec3 offset = lane.vector(args.lane_x_before, i), turned = change * offset;
            const Vec3 relative = lane.vector(args.lane_v_before, i) -
                                  velocity(was, root_was + offset, params.h, true);
            lane.store(args.lane_x_before, i, turned);
            lane.store(args.lane_v_before, i,
                       Vec3(change * relative + velocity(is, root_is + turned, params.h, true)));
        }
    }
}

} // namespace plait::reference
