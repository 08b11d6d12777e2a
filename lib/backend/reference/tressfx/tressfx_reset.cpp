// tressfx_reset: the skinned rest position with an empty history, so that the velocity is zero.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void tressfx_reset(uint32_t item_count, const plait_layout_params& params,
                   const tressfx_reset_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Pose pose = pose_of(args.pose, strand_vertex(item, params.vertex_stride).strand);
        set_xyz(args.position[item], pose.apply(xyz(args.rest[item])));
        args.position_prev[item] = args.position[item];
        args.position_prev2[item] = args.position[item];
    }
}

} // namespace plait::reference
