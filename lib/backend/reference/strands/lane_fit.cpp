// lane_fit: x_{i+1} = x_i + l_i n(edge i), n of the edges as they were, an edge that is off by less
// than rounding as it was, or without `lengths` all; x_before = x - h v of what v belongs to: rows
// from 1 on are relative to the root, row 0 is the root's own.
#include "backend/reference/base/lanes.hpp"

#include <plait/constants.h>

namespace plait::reference {
namespace {

std::vector<Vec3> fitted(const Lane& lane, const View<double>& x,
                         const View<const double>& material, uint32_t vertices) {
    std::vector<Vec3> list(vertices, Vec3::Zero());
    Vec3 last = Vec3::Zero();
    for (uint32_t i = 1; i < vertices; ++i) {
        const Vec3 now = lane.vector(x, i);
        const double length =
            material[lane.index(i - 1, PLAIT_LANE_LENGTH, PLAIT_LANE_MATERIAL_COMPONENTS)];
        const Vec3 edge = now - last;
        const bool holds = std::abs(edge.norm() - length) <= PLAIT_LANE_FIT_TOLERANCE * length;
        list[i] = list[i - 1] + (holds ? edge : Vec3(length * direction(edge)));
        last = now;
    }
    return list;
}

std::vector<Vec3> kept(const Lane& lane, const View<double>& x, uint32_t vertices) {
    std::vector<Vec3> list;
    for (uint32_t i = 0; i < vertices; ++i)
        list.push_back(lane.vector(x, i));
    return list;
}

} // namespace

void lane_fit(uint32_t item_count, const plait_lane_fit_params& params, const lane_fit_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const Lane lane(args.lane_slot[2 * item + 1], params.vertex_stride, params.tile);
        std::vector<Vec3> x =
            params.lengths ? fitted(lane, args.lane_x, args.lane_material, params.vertex_stride)
                           : kept(lane, args.lane_x, params.vertex_stride);
        x[0] = lane.vector(args.lane_x, 0);
        const Vec3 root_v = lane.vector(args.lane_v, 0);
        for (uint32_t i = 0; i < params.vertex_stride; ++i) {
            lane.store(args.lane_x, i, x[i]);
            if (!params.history)
                continue;
            const Vec3 v = lane.vector(args.lane_v, i), moved = i == 0 ? v : Vec3(v - root_v);
            lane.store(args.lane_x_before, i, Vec3(x[i] - double(params.h) * moved));
            lane.store(args.lane_v_before, i, v);
        }
    }
}

} // namespace plait::reference
