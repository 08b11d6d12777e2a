// roots: where every root is inside a step. Normalised linear interpolation along the shorter arc,
// whose speed varies by less than 1 % below a quarter turn; with `bends` Lagrange's polynomial through
// the poses at -1, 0 and 1.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {
namespace {

Pose interpolate(const Pose& from, const Pose& to, double alpha) {
    const double sign = from.q.dot(to.q) < 0 ? -1 : 1;
    Quat q;
    q.coeffs() = (1 - alpha) * from.q.coeffs() + alpha * sign * to.q.coeffs();
    return {q.normalized(), (1 - alpha) * from.t + alpha * to.t};
}

Pose on_parabola(const Pose& before, const Pose& from, const Pose& to, double s) {
    const double weights[] = {0.5 * s * (s - 1), 1 - s * s, 0.5 * s * (s + 1)};
    const Pose* const poses[] = {&before, &from, &to};
    Quat q;
    q.coeffs().setZero();
    Vec3 t = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
        const double sign = from.q.dot(poses[i]->q) < 0 ? -1 : 1;
        q.coeffs() += weights[i] * sign * poses[i]->q.coeffs();
        t += weights[i] * poses[i]->t;
    }
    return {q.normalized(), t};
}

Pose compose(const Pose& outer, const Pose& inner) {
    return {outer.q * inner.q, outer.apply(inner.t)};
}

} // namespace

void roots(uint32_t item_count, const plait_roots_params& params, const roots_args& args) {
    const Pose before{quat(params.head_before_q), vec3(params.head_before_t)};
    const Pose from{quat(params.head_from_q), vec3(params.head_from_t)};
    const Pose to{quat(params.head_to_q), vec3(params.head_to_t)};
    const Pose head = params.bends ? on_parabola(before, from, to, params.alpha)
                                   : interpolate(from, to, params.alpha);
    for (size_t strand = 0; strand < item_count; ++strand) {
        Pose pose = head;
        if (params.per_root) {
            const Pose own_from = pose_of(args.root_from, strand);
            const Pose own_to = pose_of(args.root_to, strand);
            pose = compose(head, params.bends ? on_parabola(pose_of(args.root_before, strand),
                                                            own_from, own_to, params.alpha)
                                              : interpolate(own_from, own_to, params.alpha));
        }
        store_pose(args.pose, strand, pose);
    }
}

} // namespace plait::reference
