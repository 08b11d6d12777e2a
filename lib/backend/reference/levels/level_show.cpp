// level_show: the pose of what was kept, or a share of the turned offset on top of the position.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void level_show(uint32_t item_count, const plait_level_params& params,
                const level_show_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t guide = args.root_guide[strand_vertex(item, params.vertex_stride).strand];
        const Pose root = pose_of(args.root_pose, guide);
        const Vec4 kept = args.held[item], x = args.position[item];
        args.position[item] =
            params.whole ? with_w(root.apply(xyz(kept)), kept.w())
                         : with_w(xyz(x) + double(params.share) * (root.q * xyz(kept)), x.w());
    }
}

} // namespace plait::reference
