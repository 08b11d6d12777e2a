// tressfx_teleport: the rigid motion pose_to * pose_from^-1 applied to the state and its whole history, so
// that velocities turn with the head and no segment changes length.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void tressfx_teleport(uint32_t item_count, const plait_layout_params& params,
                      const tressfx_teleport_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t strand = strand_vertex(item, params.vertex_stride).strand;
        const Pose from = pose_of(args.pose_from, strand);
        const Pose to = pose_of(args.pose_to, strand);
        for (const auto* state : {&args.position, &args.position_prev, &args.position_prev2}) {
            Vec4& x = (*state)[item];
            set_xyz(x, to.apply(from.invert(xyz(x))));
        }
    }
}

} // namespace plait::reference
