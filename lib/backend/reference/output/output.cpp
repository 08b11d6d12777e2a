// output: show the hair between the step before the last (alpha = 0) and the last (alpha = 1),
// attached to the roots of now. Interpolating in the root frames keeps the roots on the scalp
// however fast the head moves.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void output(uint32_t item_count, const plait_output_params& params, const output_args& args) {
    const double alpha = params.alpha;
    for (size_t item = 0; item < item_count; ++item) {
        const size_t strand = strand_vertex(item, params.vertex_stride).strand;
        const Vec4& x = args.position[item];
        const Vec3 before = xyz(args.position_local[item]);
        const Vec3 last = pose_of(args.pose, strand).invert(xyz(x));
        const Vec3 shown = (1 - alpha) * before + alpha * last;
        args.position_out[item] = with_w(pose_of(args.pose_now, strand).apply(shown), x.w());
    }
}

} // namespace plait::reference
