#include "core/mesh/mesh_skin.hpp"

#include "base/format.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plait {
namespace {

using Affine = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

// A bone of less volume than this, in cubes of its longest axis, has flattened what it moves.
constexpr double least_volume = 1e-9;

Affine affine(const BoneMatrix& bone) {
    return Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(bone.data())
        .cast<double>();
}

double weight_of(const BoneIndices& bones, const BoneWeights& weights, uint32_t bone) {
    double sum = 0;
    for (size_t k = 0; k < 4; ++k)
        sum += bones[k] == bone ? double(weights[k]) : 0;
    return sum;
}

bool stands_before(const BoneIndices& bones, size_t k) {
    return std::find(bones.begin(), bones.begin() + static_cast<std::ptrdiff_t>(k), bones[k]) !=
           bones.begin() + static_cast<std::ptrdiff_t>(k);
}

Status check_bone(const BoneMatrix& bone, size_t index) {
    const auto wrong = [&](const std::string& what) {
        return Error{PLAIT_INVALID_ARGUMENT, format("bones[%zu] %s", index, what.c_str())};
    };
    for (const float value : bone)
        if (!std::isfinite(value))
            return wrong(format("has %g, allowed is finite", double(value)));
    const Eigen::Matrix3d m = affine(bone).leftCols<3>();
    const double volume = m.determinant(), longest = m.colwise().norm().maxCoeff();
    if (!(std::abs(volume) > least_volume * longest * longest * longest))
        return wrong(format("is singular: its determinant is %g; allowed is above 0", volume));
    if (volume < 0)
        return wrong(format("reflects: its determinant is %g; allowed is above 0", volume));
    return {};
}

} // namespace

std::array<char, 64> bone_name(std::string_view name) {
    std::array<char, 64> to{};
    size_t size = std::min(name.size(), to.size() - 1);
    while (size > 0 && size < name.size() &&
           (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80)
        --size;
    std::copy_n(name.begin(), size, to.begin());
    return to;
}

double skin_difference(const MeshSkin& a, size_t vertex_a, const MeshSkin& b, size_t vertex_b) {
    const BoneIndices &bones_a = a.indices[vertex_a], &bones_b = b.indices[vertex_b];
    const BoneWeights &weights_a = a.weights[vertex_a], &weights_b = b.weights[vertex_b];
    double sum = 0;
    for (size_t k = 0; k < 4; ++k) {
        if (!stands_before(bones_a, k))
            sum += std::abs(weight_of(bones_a, weights_a, bones_a[k]) -
                            weight_of(bones_b, weights_b, bones_a[k]));
        if (!stands_before(bones_b, k) && std::ranges::find(bones_a, bones_b[k]) == bones_a.end())
            sum += std::abs(weight_of(bones_b, weights_b, bones_b[k]));
    }
    return sum;
}

BoneWeights normalized(const BoneWeights& weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    BoneWeights to{};
    for (size_t k = 0; k < 4; ++k)
        to[k] = static_cast<float>(double(weights[k]) / sum);
    return to;
}

Status pose_mesh(std::span<const std::array<float, 3>> rest, const MeshSkin& skin,
                 std::span<const BoneMatrix> bones, float* positions) {
    if (bones.size() < skin.bones.size())
        return Error{PLAIT_INVALID_ARGUMENT, format("bones.count is %zu, the mesh's skin needs %zu",
                                                    bones.size(), skin.bones.size())};
    for (size_t bone = 0; bone < skin.bones.size(); ++bone)
        PLAIT_TRY(check_bone(bones[bone], bone));
    for (size_t i = 0; i < rest.size(); ++i) {
        Affine blend = Affine::Zero();
        double sum = 0;
        for (size_t k = 0; k < 4; ++k)
            if (const double weight = double(skin.weights[i][k]); weight > 0) {
                blend += weight * affine(bones[skin.indices[i][k]]);
                sum += weight; // but for rounding 1, which the identity must not show
            }
        const Eigen::Vector4d p(double(rest[i][0]), double(rest[i][1]), double(rest[i][2]), 1);
        Eigen::Map<Eigen::Vector3f>(positions + 3 * i) = (blend / sum * p).cast<float>();
    }
    return {};
}

} // namespace plait
