// level_keep: positions in the frames of their roots, or q^-1 of what is lacking to them.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void level_keep(uint32_t item_count, const plait_level_params& params,
                const level_keep_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t guide = args.root_guide[strand_vertex(item, params.vertex_stride).strand];
        const Pose root = pose_of(args.root_pose, guide);
        const Vec4 x = args.position[item], was = args.held[item];
        args.held[item] = params.whole ? with_w(root.invert(xyz(x)), x.w())
                                       : with_w(root.q.conjugate() * (xyz(was) - xyz(x)), was.w());
    }
}

} // namespace plait::reference
