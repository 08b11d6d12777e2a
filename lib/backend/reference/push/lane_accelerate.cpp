// lane_accelerate: the accelerations of a strand's vertices, in its lane.
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {

void lane_accelerate(uint32_t item_count, const plait_lane_tile_params& params,
                     const lane_accelerate_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            Vec3 own = Vec3::Zero();
            if (i < count)
                own = checked_acceleration(args.acceleration[strand * params.row_stride + i]);
            if (i < count && params.pressure)
                own += lane.vector(args.lane_pressure, i);
            lane.store(args.lane_acceleration, i, own);
        }
    }
}

} // namespace plait::reference
