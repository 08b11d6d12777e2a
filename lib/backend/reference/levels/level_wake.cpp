// level_wake: x along the segments as shown, at their lengths at rest; v from the two places the guides
// give; orientations by parallel transport from rest, at both ends of the step.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

template <typename Rows> Vec3 segment(const Rows& rows, size_t vertex) {
    return xyz(rows[vertex + 1]) - xyz(rows[vertex]);
}

Quat carried(const Quat& before, const Vec3& at_rest, const Vec3& now) {
    return (turn(before * at_rest, now) * before).normalized();
}

Quat between(const Quat& a, const Quat& b, double s) {
    const double sign = a.dot(b) < 0 ? -1 : 1;
    return Quat((1 - s) * a.coeffs() + sign * s * b.coeffs()).normalized();
}

void wake(const plait_level_wake_params& params, const level_wake_args& args, size_t number) {
    const Lane lane(number, params.vertex_stride, params.tile);
    const size_t strand = strand_of(args.lane_strand, number), row = strand * params.row_stride;
    const Pose before = pose_of(args.pose_before, strand), now = pose_of(args.pose, strand);
    const double step = double(params.step), h = double(params.h);
    const Vec3 origin = xyz(args.rest[row]), root = now.apply(origin);
    const Vec3 root_v = (root - before.apply(origin)) / step;
    Quat q_now = now.q, q_before = before.q, joints = Quat::Identity();
    Vec3 way = Vec3::Zero();
    for (uint32_t i = 0; i < params.vertex_stride; ++i) {
        const Vec3 to = xyz(args.wake_to[row + i]) - xyz(args.wake_to[row]);
        const Vec3 from = xyz(args.wake_from[row + i]) - xyz(args.wake_from[row]);
        const Vec3 v = (to - from) / step, x = i > 0 ? way : root;
        const Vec3 v_all = i > 0 ? Vec3(root_v + v) : root_v;
        lane.store(args.lane_x, i, x);
        lane.store(args.lane_v, i, v_all);
        args.lane_normal_force[lane.index(i, 0, 1)] = 0;
        if (params.history) {
            lane.store(args.lane_x_before, i, Vec3(x - h * (i > 0 ? v : root_v)));
            lane.store(args.lane_v_before, i, v_all);
        }
        if (i + 1 < params.vertex_stride) {
            const Vec3 at_rest = segment(args.rest, row + i);
            const Vec3 shown = segment(args.position, row + i);
            q_now = carried(q_now, at_rest, shown);
            q_before = carried(q_before, at_rest, segment(args.wake_from, row + i));
            if (!shown.isZero(0))
                way += at_rest.norm() * shown.normalized();
        }
        joints = joints * lane.rotation(args.lane_rest, i);
        const Quat q = q_now * joints;
        lane.store(args.lane_q, i, q);
        lane.store(args.lane_q_before, i, between(q, q_before * joints, h / step));
    }
}

} // namespace

void level_wake(uint32_t item_count, const plait_level_wake_params& params,
                const level_wake_args& args) {
    for (size_t item = 0; item < item_count; ++item)
        wake(params, args, params.strand_first + item);
}

} // namespace plait::reference
