// output: show the hair between the step before the last (alpha = 0) and the last (alpha = 1),
// attached to the roots of now. Interpolating in the root frames keeps the roots on the scalp
// however fast the head moves; interpolating direction and distance keeps what swings on its arc.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void output(uint32_t item_count, const plait_output_params& params, const output_args& args) {
    const double alpha = params.alpha;
    const auto between = [alpha](const Vec3& before, const Vec3& last) -> Vec3 {
        return (1 - alpha) * before + alpha * last;
    };
    for (size_t item = 0; item < item_count; ++item) {
        const size_t strand = strand_vertex(item, params.vertex_stride).strand;
        const size_t first = strand * params.vertex_stride;
        const auto pose_last = pose_of(args.pose, strand);
        const Vec3 root_before = xyz(args.position_local[first]);
        const Vec3 root_last = pose_last.invert(xyz(args.position[first]));
        const Vec4& x = args.position[item];
        const Vec3 before = xyz(args.position_local[item]) - root_before;
        const Vec3 last = pose_last.invert(xyz(x)) - root_last;

        const Vec3 chord = between(before, last);
        const double near = chord.norm();
        const double far = (1 - alpha) * before.norm() + alpha * last.norm();
        const Vec3 shown =
            between(root_before, root_last) + (near > 0.1 * far ? far / near : 1) * chord;
        args.position_out[item] = with_w(pose_of(args.pose_now, strand).apply(shown), x.w());
    }
}

} // namespace plait::reference
