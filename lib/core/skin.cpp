#include "core/skin.hpp"

#include "base/format.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace plait {
namespace {

Status check_bone(const BoneMatrix& bone, size_t index) {
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
    return {};
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

Status Skin::check(std::span<const BoneMatrix> bones) const {
    if (bones_ == 0)
        return Error{PLAIT_INVALID_ARGUMENT, "bones are given, but the groom has no skin"};
    if (bones.size() < bones_)
        return Error{PLAIT_INVALID_ARGUMENT,
                     format("bones.count is %zu, the groom's skin needs %u", bones.size(), bones_)};
    for (size_t bone = 0; bone < bones_; ++bone)
        PLAIT_TRY(check_bone(bones[bone], bone));
    return {};
}

void Skin::append(Schedule& schedule, const Layout& layout, const State& state,
                  const Buffer& poses) const {
    if (bones_ > 0)
        schedule.add(PLAIT_STAGE_skin, layout.guides, plait_layout_params{layout.row},
                     {&matrix_, &index_, &weight_, &state.rest, &poses});
}

Status Skin::append(Device& device, Schedule& schedule, const Layout& layout, const State& state,
                    std::span<const BoneMatrix> bones, const Buffer& poses) const {
    PLAIT_TRY(device.upload(matrix_, bones.data()));
    append(schedule, layout, state, poses);
    return {};
}

} // namespace plait
