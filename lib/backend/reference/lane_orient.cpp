// lane_orient: q_i = turn(director of q_(i-1) r_i -> edge i) q_(i-1) r_i, q_(-1) the pose's; no
// turn where the edge has no length. Of the step before: the same with edge - h (v_(i+1) - v_i),
// but the first segment keeps its direction.
#include "backend/reference/lanes.hpp"

namespace plait::reference {
namespace {

std::vector<Vec3> edges(const Lane& lane, const View<const double>& points, uint32_t vertices) {
    std::vector<Vec3> list(vertices, Vec3::Zero());
    for (uint32_t i = 0; i + 1 < vertices; ++i)
        list[i] = lane.vector(points, i + 1) -
                  (i == 0 ? Vec3(Vec3::Zero()) : lane.vector(points, i)); // row 0 is the root
    return list;
}

void orient(const Lane& lane, const std::vector<Vec3>& along, Quat q,
            const View<const double>& rest, const View<double>& to) {
    for (size_t i = 0; i < along.size(); ++i) {
        q = q * lane.rotation(rest, i);
        q = (turn(q * Vec3::UnitX(), along[i]) * q).normalized();
        lane.store(to, i, q);
    }
}

} // namespace

void lane_orient(uint32_t item_count, const plait_lane_layout_params& params,
                 const lane_orient_args& args) {
    for (size_t item = 0; item < item_count; ++item) {
        const size_t slot = args.lane_slot[2 * item + 1];
        const Lane lane(slot, params.vertex_stride, params.tile);
        const Quat root = pose_of(args.pose, strand_of(args.lane_strand, slot)).q;
        std::vector<Vec3> along = edges(lane, args.lane_x, params.vertex_stride);
        orient(lane, along, root, args.lane_rest, args.lane_q);
        const std::vector<Vec3> relative = edges(lane, args.lane_v, params.vertex_stride);
        for (size_t i = 1; i < along.size(); ++i)
            along[i] -= params.h * relative[i];
        orient(lane, along, root, args.lane_rest, args.lane_q_before);
    }
}

} // namespace plait::reference
