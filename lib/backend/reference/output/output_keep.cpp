// output_keep: keep a step's positions in the frames of their roots, local = conj(q) (x - t).
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void output_keep(uint32_t item_count, const plait_layout_params& params,
                 const output_keep_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Pose pose = pose_of(args.pose, strand_vertex(item, params.vertex_stride).strand);
        const Vec4& x = args.position[item];
        args.position_local[item] = with_w(pose.invert(xyz(x)), x.w());
    }
}

} // namespace plait::reference
