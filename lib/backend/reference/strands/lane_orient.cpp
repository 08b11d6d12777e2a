// lane_orient: q_i = turn(director of q_(i-1) r_i -> edge i) q_(i-1) r_i, q_(-1) the pose's; no
// turn where the edge has no length. Of the step before: the same with edge - h (v_(i+1) - v_i).
#include "backend/reference/base/lanes.hpp"

namespace plait::reference {
namespace {

// Of each row and the next, `last` in place of the first; zero after the end.
std::vector<Vec3> differences(const Lane& lane, const View<const double>& rows, Vec3 last,
                              uint32_t vertices) {
    std::vector<Vec3> list(vertices, Vec3::Zero());
    for (uint32_t i = 0; i + 1 < vertices; ++i) {
        const Vec3 next = lane.vector(rows, i + 1);
        list[i] = next - last;
        last = next;
    }
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
        std::vector<Vec3> along =
            differences(lane, args.lane_x, Vec3::Zero(), params.vertex_stride);
        orient(lane, along, root, args.lane_rest, args.lane_q);
        const std::vector<Vec3> turning =
            differences(lane, args.lane_v, lane.vector(args.lane_v, 0), params.vertex_stride);
        for (size_t i = 0; i < along.size(); ++i)
            along[i] -= params.h * turning[i];
        orient(lane, along, root, args.lane_rest, args.lane_q_before);
    }
}

} // namespace plait::reference
