// tressfx_set_off: histories M brought here come from where N would have brought them from: N^-1 M x, and
// N^-2 M^2 x of the step before the last.
#include "backend/reference/strands/set_off.hpp"

namespace plait::reference {
namespace {

Pose earlier(const Pose& now, const Pose& next) {
    return carried(now, next, now);
}

} // namespace

void tressfx_set_off(uint32_t item_count, const plait_set_off_params& params,
                     const tressfx_set_off_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t strand = strand_vertex(item, params.vertex_stride).strand;
        const Pose now = pose_of(args.pose, strand);
        const Pose was =
            carried(pose_of(args.pose_before, strand), pose_of(args.pose_was, strand), now);
        const Pose is = earlier(now, pose_of(args.pose_next, strand));
        const Vec3 rest = xyz(args.rest[strand * params.row_stride]);
        if (!sets_off({was, now}, {is, now}, now.apply(rest), params))
            continue;
        Vec4& last = args.position_prev[item];
        Vec4& first = args.position_prev2[item];
        set_xyz(last, is.apply(was.invert(xyz(last))));
        set_xyz(first, earlier(is, now).apply(earlier(was, now).invert(xyz(first))));
    }
}

} // namespace plait::reference
