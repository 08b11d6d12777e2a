// global_shape: pull the vertices near the root towards the skinned rest shape,
//   x += s_G (rest - x)   for i < range * count.
// Source: Han & Harada 2012, section 3.3.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void global_shape(uint32_t item_count, const plait_global_shape_params& params,
                  const global_shape_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const auto [strand, i] = strand_vertex(item, params.vertex_stride);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        Vec4& position = args.position[item];
        if (i >= static_cast<double>(params.range) * count || pinned(position))
            continue;
        const Vec3 x = xyz(position);
        const Vec3 rest = pose_of(args.pose, strand).apply(xyz(args.rest[item]));
        set_xyz(position, x + params.stiffness * (rest - x));
    }
}

} // namespace plait::reference
