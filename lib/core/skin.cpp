#include "core/skin.hpp"

#include "base/format.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace plait {
namespace {

using Blend = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

Blend blend(const Skin& skin, std::span<const BoneMatrix> bones, size_t strand) {
    Blend sum = Blend::Zero();
    for (size_t k = 4 * strand; k < 4 * strand + 4; ++k)
        if (const float weight = skin.bone_weights[k]; weight > 0)
            sum += weight * Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(
                                bones[skin.bone_indices[k]].data())
                                .cast<double>();
    return sum;
}

// The rotation nearest to `m` in the Frobenius norm: U diag(1, 1, det) V^T of its SVD (Kabsch
// 1976). False: not unique.
bool closest_rotation(const Eigen::Matrix3d& m, Eigen::Matrix3d& rotation) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (!(svd.singularValues()[1] > 1e-6 * svd.singularValues()[0]))
        return false;
    Eigen::Vector3d signs(1, 1, 1);
    signs[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
    return true;
}

plait_pose to_pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
    const Eigen::Quaternionf q = Eigen::Quaterniond(rotation).normalized().cast<float>();
    const Eigen::Vector3f t = translation.cast<float>();
    return {{q.x(), q.y(), q.z(), q.w()}, {t[0], t[1], t[2]}};
}

} // namespace

Skin::Skin(const Groom& groom, std::pmr::memory_resource* memory) : Skin(memory) {
    bones = groom.shape.bones;
    if (bones == 0)
        return;
    bone_indices = groom.strands.bone_indices;
    bone_weights = groom.strands.bone_weights;
    roots.reserve(3 * groom.shape.strands);
    const float* vertex = groom.strands.positions.data();
    for (const uint32_t count : groom.strands.vertex_counts) {
        roots.insert(roots.end(), vertex, vertex + 3);
        vertex += size_t{3} * count;
    }
}

Status skin_roots(const Skin& skin, std::span<const BoneMatrix> bones,
                  std::span<plait_pose> poses) {
    for (size_t strand = 0; strand < poses.size(); ++strand) {
        const Blend m = blend(skin, bones, strand);
        Eigen::Matrix3d rotation;
        if (!m.allFinite() || !closest_rotation(m.leftCols<3>(), rotation))
            return Error{PLAIT_INVALID_ARGUMENT,
                         format("bones: the blend for strand %zu is no rotation", strand)};
        const Eigen::Vector3d root =
            Eigen::Map<const Eigen::Vector3f>(skin.roots.data() + 3 * strand).cast<double>();
        poses[strand] = to_pose(rotation, m.leftCols<3>() * root + m.col(3) - rotation * root);
    }
    return {};
}

} // namespace plait
