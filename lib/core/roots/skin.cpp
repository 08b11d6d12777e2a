#include "core/roots/skin.hpp"

#include "base/format.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

constexpr double even = 0.01; // bones of scales that differ by less are of one

using Axes = std::array<double, 3>;

// To 1 part in 65536, so that rounding makes no scale of a rotation.
float rounded(double scale) {
    int exponent;
    const double mantissa = std::frexp(scale, &exponent);
    return static_cast<float>(std::ldexp(std::round(std::ldexp(mantissa, 16)), exponent - 16));
}

double farthest(const Axes& axes, double scale) {
    double most = 0;
    for (const double axis : axes)
        most = std::max(most, std::abs(axis / scale - 1));
    return most;
}

// What it scales by along its axes.
Result<Axes> check_bone(const BoneMatrix& bone, size_t index) {
    const Eigen::Matrix3d m =
        Eigen::Map<const Eigen::Matrix<float, 3, 4, Eigen::RowMajor>>(bone.data())
            .leftCols<3>()
            .cast<double>();
    const Eigen::Vector3d singular = Eigen::JacobiSVD<Eigen::Matrix3d>(m).singularValues();
    if (!(singular[1] > 1e-6 * singular[0]))
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("bones[%zu] has no closest rotation: it maps all to a line", index)};
    // a flat blend has a rotation, too, which tells nothing of mirrors
    if (singular[2] > 1e-6 * singular[0] && m.determinant() < 0)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("bones[%zu] mirrors: its determinant is %g; allowed is above 0. A "
                            "mirrored character is a groom that is mirrored when it is imported",
                            index, m.determinant())};
    return Axes{singular[0], singular[1], singular[2]};
}

} // namespace

Result<Skin> Skin::create(Device& device, const Groom& groom) {
    Skin skin;
    skin.bones_ = groom.shape.bones;
    if (skin.bones_ == 0)
        return skin;
    const auto& strands = groom.strands;
    PLAIT_TRY(
        device.create(skin.index_, PLAIT_ELEMENT_UINT, strands.bone_indices.size(), "bone_index"));
    PLAIT_TRY(device.create(skin.weight_, PLAIT_ELEMENT_FLOAT, strands.bone_weights.size(),
                            "bone_weight"));
    PLAIT_TRY(
        device.create(skin.matrix_, PLAIT_ELEMENT_FLOAT4, size_t{3} * skin.bones_, "bone_matrix"));
    PLAIT_TRY(device.write(skin.index_, strands.bone_indices.data()));
    PLAIT_TRY(device.write(skin.weight_, strands.bone_weights.data()));
    return skin;
}

bool Skin::Scale::is_even() const {
    return farthest(of_bone, double(all)) <= even;
}

Result<Skin::Scale> Skin::scale_of(std::span<const BoneMatrix> bones,
                                   std::pmr::memory_resource* memory) const {
    if (bones_ == 0)
        return Error{PLAIT_INVALID_ARGUMENT, "bones are given, but the groom has no skin"};
    if (bones.size() < bones_)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("bones.count is %zu, the groom's skin needs %u", bones.size(), bones_)};
    std::pmr::vector<Axes> axes(memory);
    std::pmr::vector<double> means(memory);
    for (size_t bone = 0; bone < bones_; ++bone) {
        const auto own = check_bone(bones[bone], bone);
        if (!own)
            return own.error();
        axes.push_back(*own);
        means.push_back(std::cbrt((*own)[0] * (*own)[1] * (*own)[2]));
    }
    const auto middle = means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2);
    std::nth_element(means.begin(), middle, means.end());
    Scale scale;
    if (*middle > 0) // else most are flat, and tell none
        scale.all = rounded(*middle);
    const auto odd = std::ranges::max_element(
        axes, {}, [&](const Axes& own) { return farthest(own, double(scale.all)); });
    scale.bone = static_cast<size_t>(odd - axes.begin());
    scale.of_bone = *odd;
    return scale;
}

void Skin::append(Schedule& schedule, const Layout& layout, const State& state,
                  const Buffer& poses) const {
    if (bones_ > 0)
        schedule.add(PLAIT_STAGE_skin, layout.guides, plait_layout_params{layout.row},
                     {&matrix_, &index_, &weight_, &state.rest, &poses});
}

Status Skin::append(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                    std::span<BoneMatrix> bones, float own, float scale,
                    const Buffer& poses) const {
    for (BoneMatrix& bone : bones)
        for (size_t i = 0; i < bone.size(); ++i)
            bone[i] /= i % 4 == 3 ? scale : own;
    PLAIT_TRY(device.upload(matrix_, bones.data()));
    append(schedule, layout, state, poses);
    return {};
}

} // namespace plait
