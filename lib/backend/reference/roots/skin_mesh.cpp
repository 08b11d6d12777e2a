// skin_mesh: the root keeps its place in the frame of its triangle: two edges, and the unit normal.
#include "backend/reference/base/stages.hpp"
#include "backend/reference/roots/skin.hpp"

#include <Eigen/LU>

#include <array>

namespace plait::reference {
namespace {

using Mat3 = Eigen::Matrix3d;

// Columns: two edges from the first corner, and the unit normal, 0 where there is no area.
Mat3 frame_of(const std::array<Vec3, 3>& corners) {
    Mat3 frame;
    frame.col(0) = corners[1] - corners[0];
    frame.col(1) = corners[2] - corners[0];
    const Vec3 n = frame.col(0).cross(frame.col(1));
    frame.col(2) = n.norm() > 0 ? Vec3(n.normalized()) : Vec3(Vec3::Zero());
    return frame;
}

} // namespace

void skin_mesh(uint32_t item_count, const plait_layout_params& params, const skin_mesh_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        std::array<Vec3, 3> then, now;
        for (size_t k = 0; k < 3; ++k) {
            const size_t corner = args.skin_corner[3 * strand + k];
            then[k] = xyz(args.skin_rest[corner]);
            now[k] = xyz(args.skin_at[corner]);
        }
        const Mat3 m = frame_of(now) * frame_of(then).inverse();
        const Vec3 root = xyz(args.rest[strand * params.vertex_stride]);
        store_pose(args.pose, strand, skinned_pose(m, now[0] - m * then[0], root));
    }
}

} // namespace plait::reference
