#include "body.hpp"
#include "common/json_reader.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace simulate {

using Eigen::Affine3f;

namespace {

using Matrix = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

constexpr const char* carrier_names[] = {"bone", "skin"};

bool alike(const std::string& a, const std::string& b) {
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::vector<plait_mesh_bone_info> bones_of(const LoadedMesh& mesh) {
    plait_mesh_info info = plait_mesh_info_defaults();
    check(plait_mesh_describe(mesh.mesh.get(), &info));
    std::vector<plait_mesh_bone_info> bones(info.bones, plait_mesh_bone_info_defaults());
    for (uint32_t bone = 0; bone < info.bones; ++bone)
        check(plait_mesh_read_bone(mesh.mesh.get(), bone, &bones[bone]));
    if (bones.empty())
        throw Failure(mesh.choice.place + ": " + mesh.choice.file +
                      " has no bones: allowed are "
                      "a .gltf or .glb with a skin");
    return bones;
}

size_t bone_named(const std::vector<plait_mesh_bone_info>& bones, const BodyChoice& choice) {
    std::vector<std::string> names;
    for (const plait_mesh_bone_info& bone : bones)
        names.emplace_back(bone.name);
    auto found = std::ranges::find(names, choice.bone);
    if (found == names.end())
        found = std::ranges::find_if(
            names, [&](const std::string& name) { return alike(name, choice.bone); });
    if (found == names.end())
        throw Failure(choice.bone_place + " is \"" + choice.bone + "\", which none of the " +
                      std::to_string(names.size()) + " bones of " + choice.mesh.file +
                      " is; the nearest is \"" + std::string(nearest(choice.bone, names)) + "\"");
    return static_cast<size_t>(found - names.begin());
}

} // namespace

BodyChoice read_body(const JsonReader& top, const Json& value, const std::string& folder) {
    JsonReader in = top.object(value, "body");
    BodyChoice body;
    body.mesh.desc.form = PLAIT_MESH_FORM_NEAREST;
    read_mesh(in, folder, body.mesh);
    if (alike(std::filesystem::path(body.mesh.file).extension().string(), ".tfxmesh"))
        in.fail("file",
                "is \"" + body.mesh.file +
                    "\", and .tfxmesh holds no animation; allowed are .gltf and .glb. A mesh "
                    "that goes with the head and does not bend is one of \"meshes\"");
    if (body.mesh.hull || body.mesh.desc.form != PLAIT_MESH_FORM_NEAREST)
        in.fail("form", std::string("is \"") + (body.mesh.hull ? "hull" : "field") +
                            "\", which does not bend; allowed is \"nearest\"");
    if (const Json* animation = in.value("animation")) {
        if (!animation->is_number_unsigned() && !animation->is_string())
            in.fail("animation",
                    "is " + animation->dump() + ", neither a number of one, from 0, nor a name");
        if (animation->is_string())
            body.animation = animation->get<std::string>();
        else
            body.animation = animation->get<uint64_t>();
    }
    in.text("bone", body.bone);
    in.choice("roots", body.roots, carrier_names);
    in.finish();
    body.animation_place = in.place("animation");
    body.bone_place = in.place("bone");
    return body;
}

Body::Body(const BodyChoice& choice, bool generated)
    : mesh_(load_mesh(choice.mesh, generated)), roots_(choice.roots),
      animation_(choice.mesh.file, choice.animation, choice.animation_place) {
    const auto bones = bones_of(mesh_);
    for (const plait_mesh_bone_info& bone : bones) {
        const auto node = animation_.find(bone.name);
        if (!node)
            throw Failure(choice.mesh.place + ": " + choice.mesh.file + ": no node is the bone \"" +
                          bone.name + "\"");
        Affine3f inverse_bind = Affine3f::Identity();
        inverse_bind.affine() = Eigen::Map<const Matrix>(bone.inverse_bind);
        bones_.push_back({*node, inverse_bind});
    }
    head_ = bone_named(bones, choice);
    motion_ =
        animation_.name() + " of " + std::filesystem::path(choice.mesh.file).filename().string();
}

Affine3f Body::skinning(size_t bone, float time) const {
    Affine3f pose = animation_.world(bones_[bone].node, time);
    pose.translation() *= mesh_.choice.scale;
    return pose * bones_[bone].inverse_bind;
}

std::vector<std::array<float, 3>> Body::positions(float time) const {
    std::vector<Matrix> matrices;
    for (size_t bone = 0; bone < bones_.size(); ++bone)
        matrices.emplace_back(skinning(bone, time).affine());
    const plait_view view{matrices.data(), matrices.size(), sizeof(Matrix)};
    std::vector<std::array<float, 3>> positions(mesh_.shape.vertices.size());
    check(plait_mesh_pose(mesh_.mesh.get(), &view, positions.data()->data()));
    return positions;
}

plait_pose Body::head(float time) const {
    const Affine3f skin = skinning(head_, time);
    const Eigen::Quaternionf turn = Eigen::Quaternionf(skin.rotation()).normalized();
    return {{turn.x(), turn.y(), turn.z(), turn.w()},
            {skin.translation().x(), skin.translation().y(), skin.translation().z()}};
}

} // namespace simulate
