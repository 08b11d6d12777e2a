// skin: the root follows the blend M of its bones exactly.
#include "backend/reference/roots/skin.hpp"

#include "backend/reference/base/stages.hpp"

#include <Eigen/SVD>

namespace plait::reference {
namespace {

using Mat3 = Eigen::Matrix3d;

Quat closest_rotation(const Mat3& m) {
    const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 signs(1, 1, 1);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    return Quat(Mat3(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose())).normalized();
}

} // namespace

Pose skinned_pose(const Mat3& m, const Vec3& shift, const Vec3& root) {
    const Quat q = closest_rotation(m);
    return {q, m * root + shift - q * root};
}

void skin(uint32_t item_count, const plait_layout_params& params, const skin_args& args) {
    for (size_t strand = 0; strand < item_count; ++strand) {
        Mat3 m = Mat3::Zero();
        Vec3 shift = Vec3::Zero();
        for (size_t k = 4 * strand; k < 4 * strand + 4; ++k) {
            const double weight = args.bone_weight[k];
            for (size_t row = 0; row < 3 && weight > 0; ++row) {
                const Vec4& of_bone = args.bone_matrix[3 * args.bone_index[k] + row];
                m.row(static_cast<Eigen::Index>(row)) += weight * xyz(of_bone).transpose();
                shift[static_cast<Eigen::Index>(row)] += weight * of_bone.w();
            }
        }
        const Vec3 root = xyz(args.rest[strand * params.vertex_stride]);
        store_pose(args.pose, strand, skinned_pose(m, shift, root));
    }
}

} // namespace plait::reference
