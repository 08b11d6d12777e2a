// velocity_shock: vertices from the third on take the share c of the root segment's rigid motion,
// in the present and the previous position alike, so that a sudden head motion does not stretch
// them.
//   p <- (1 - c) p + c (q p + t)
// Source: TressFX 3.1, velocity shock propagation.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void velocity_shock(uint32_t item_count, const plait_layout_params& params,
                    const velocity_shock_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        if (i < 2 || i >= count || pinned(args.position[item]))
            continue;
        const Pose motion = pose_of(args.strand_motion, strand);
        const double c = args.strand_motion[2 * strand + 1].w();
        for (const auto* state : {&args.position, &args.position_prev}) {
            Vec4& p = (*state)[item];
            set_xyz(p, (1 - c) * xyz(p) + c * motion.apply(xyz(p)));
        }
    }
}

} // namespace plait::reference
