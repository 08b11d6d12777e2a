// attach: a free vertex at arc length s from its root x_0 is kept within |x - x_0| <= reach * s.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {

void attach(uint32_t item_count, const plait_attach_params& params, const attach_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        const size_t root = strand * params.vertex_stride;
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        const Vec3 origin = xyz(args.position[root]);
        double arc = 0;
        for (size_t item = root + 1; item < root + count; ++item) {
            arc += args.rest_length[item - 1];
            Vec4& position = args.position[item];
            const Vec3 offset = xyz(position) - origin;
            const double reach = params.reach * arc;
            if (!pinned(position) && offset.norm() > reach)
                set_xyz(position, origin + offset.normalized() * reach);
        }
    }
}

} // namespace plait::reference
