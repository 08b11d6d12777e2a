// guide_turns: Q_i = turn(Q_(i-1) rest edge i -> edge i) Q_(i-1), Q_(-1) the pose's; no turn where
// the edge has no length. After the last edge Q stays.
#include "backend/reference/base/stages.hpp"

namespace plait::reference {
namespace {

template <typename Rows> Vec3 edge(const Rows& rows, size_t vertex) {
    return xyz(rows[vertex + 1]) - xyz(rows[vertex]);
}

} // namespace

void guide_turns(uint32_t item_count, const plait_layout_params& params,
                 const guide_turns_args& args) {
    for (size_t guide = 0; guide < item_count; ++guide) {
        const size_t root = guide * params.vertex_stride;
        const size_t tip = root + vertices_of(args.vertex_count, guide, params.vertex_stride) - 1;
        Quat q = pose_of(args.pose, guide).q;
        for (size_t i = root; i < root + params.vertex_stride; ++i) {
            if (i < tip)
                q = (turn(q * edge(args.rest, i), edge(args.position, i)) * q).normalized();
            args.guide_turn[i] = q.coeffs();
        }
    }
}

} // namespace plait::reference
