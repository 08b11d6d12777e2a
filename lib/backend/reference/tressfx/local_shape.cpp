// local_shape: bend every joint towards its rest angle, from root to tip, `iterations` times.
//   b_j = q rest_j,  R turns n(b_i - b_{i-1}) to n(p_i - p_{i-1}),  k = min(s_L, 0.95) / 2
//   delta = k (R (b_{i+1} - b_i) + p_i - p_{i+1}),  p_i -= delta,  p_{i+1} += delta   (free ends
//   only)
// Each joint sees what the one before it wrote (Gauss-Seidel).
// Source: Han & Harada 2012, section 3.2.
#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <algorithm>

namespace plait::reference {
namespace {

struct Strand {
    size_t root; // item of vertex 0
    uint32_t count;
    Quat bone;
};

void bend_joint(const Strand& strand, uint32_t i, double k, const local_shape_args& args) {
    const size_t item = strand.root + i;
    const auto bone_segment = [&](size_t to) {
        return Vec3(strand.bone * (xyz(args.rest[to]) - xyz(args.rest[to - 1])));
    };
    Vec4& p = args.position[item];
    Vec4& next = args.position[item + 1];
    const Quat turned = turn(bone_segment(item), xyz(p) - xyz(args.position[item - 1]));
    const Vec3 delta = k * (turned * bone_segment(item + 1) + xyz(p) - xyz(next));
    if (!pinned(p))
        set_xyz(p, xyz(p) - delta);
    if (!pinned(next))
        set_xyz(next, xyz(next) + delta);
}

} // namespace

void local_shape(uint32_t item_count, const plait_local_shape_params& params,
                 const local_shape_args& args) {
    const double k =
        std::min(static_cast<double>(params.stiffness), PLAIT_LOCAL_SHAPE_MAX_STIFFNESS) / 2;
    for (size_t s = 0; s < item_count; ++s) {
        const Strand strand{s * params.vertex_stride,
                            vertices_of(args.vertex_count, s, params.vertex_stride),
                            pose_of(args.pose, s).q};
        for (uint32_t iteration = 0; iteration < params.iterations; ++iteration)
            for (uint32_t i = 1; i + 1 < strand.count; ++i)
                bend_joint(strand, i, k, args);
    }
}

} // namespace plait::reference
