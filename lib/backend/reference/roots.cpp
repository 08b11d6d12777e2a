// roots: where every root is inside a step. Normalised linear interpolation along the shorter arc;
// its speed along the arc varies by less than 1 % below a quarter turn, which a step never exceeds.
#include "backend/reference/stages.hpp"

namespace plait::reference {
namespace {

Pose interpolate(const Pose& from, const Pose& to, double alpha) {
    const double sign = from.q.dot(to.q) < 0 ? -1 : 1;
    Quat q;
    q.coeffs() = (1 - alpha) * from.q.coeffs() + alpha * sign * to.q.coeffs();
    return {q.normalized(), (1 - alpha) * from.t + alpha * to.t};
}

Pose compose(const Pose& outer, const Pose& inner) {
    return {outer.q * inner.q, outer.apply(inner.t)};
}

} // namespace

void roots(uint32_t item_count, const plait_roots_params& params, const roots_args& args) {
    const Pose from{quat(params.head_from_q), vec3(params.head_from_t)};
    const Pose to{quat(params.head_to_q), vec3(params.head_to_t)};
    const Pose head = interpolate(from, to, params.alpha);
    for (size_t strand = 0; strand < item_count; ++strand) {
        Pose pose = head;
        if (params.per_root)
            pose = compose(head, interpolate(pose_of(args.root_from, strand),
                                             pose_of(args.root_to, strand), params.alpha));
        store_pose(args.pose, strand, pose);
    }
}

} // namespace plait::reference
