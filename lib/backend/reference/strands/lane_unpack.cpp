// lane_unpack: x_world = root + x, the history a Verlet step would have, x - h v, and tangents.
#include "backend/reference/base/lanes.hpp"
#include "backend/reference/base/tangent.hpp"

namespace plait::reference {
namespace {

void show(const lane_unpack_args& args, size_t root, uint32_t count, uint32_t row) {
    for (uint32_t i = 0; i < row; ++i) {
        args.tangent[root + i] = with_w(tangent(args.position, root, i, count), 0);
        if (i >= count)
            args.position[root + i] = args.position[root + count - 1];
    }
}

} // namespace

void lane_unpack(uint32_t item_count, const plait_lane_unpack_params& params,
                 const lane_unpack_args& args) {
    for (size_t slot = 0; slot < item_count; ++slot) {
        const size_t strand = strand_of(args.lane_strand, slot);
        const Lane lane(slot, params.vertex_stride, params.tile);
        const Vec3 root = lane.vector(args.lane_x, 0);
        const uint32_t count = vertices_of(args.vertex_count, strand, params.vertex_stride);
        for (uint32_t i = 0; i < count; ++i) {
            const size_t vertex = strand * params.row_stride + i;
            const Vec3 x = i == 0 ? root : Vec3(root + lane.vector(args.lane_x, i));
            const Vec3 v = lane.vector(args.lane_v, i);
            const double inverse_mass = i == 0 ? 0 : 1;
            args.position[vertex] = with_w(x, inverse_mass);
            args.position_prev[vertex] = with_w(x - params.h * v, inverse_mass);
        }
        if (params.shown)
            show(args, strand * params.row_stride, count, params.row_stride);
    }
}

} // namespace plait::reference
