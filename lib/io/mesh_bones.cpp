#include "io/mesh_bones.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// Matrices closer to one another than this, m and shares, are the same but for rounding.
constexpr double same = 1e-5;

bool near(const NodeMatrix& a, const NodeMatrix& b) {
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column)
            if (!(std::abs(a[row][column] - b[row][column]) <= same))
                return false;
    return true;
}

NodeMatrix inverse_or_identity(const NodeMatrix& m) {
    return std::abs(m.Determinant()) > 0 ? NodeMatrix(m).Inverse() : NodeMatrix();
}

int depth_of(const aiNode* node) {
    int depth = 0;
    for (; node; node = node->mParent)
        ++depth;
    return depth;
}

BoneMatrix rows_of(const NodeMatrix& m, double scale) {
    BoneMatrix rows{};
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column)
            rows[4 * row + column] =
                static_cast<float>(column < 3 ? m[row][column] : scale * m[row][column]);
    return rows;
}

} // namespace

NodeMatrix world_of(const aiNode& node) {
    NodeMatrix world;
    for (const aiNode* at = &node; at; at = at->mParent)
        world = NodeMatrix(at->mTransformation) * world;
    return world;
}

MeshBones::MeshBones(const std::string& file, const aiScene& scene, float scale, RawMesh& mesh)
    : file_(file), scene_(scene), scale_(double(scale)), mesh_(mesh) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        any_ = any_ || scene.mMeshes[m]->HasBones();
}

uint32_t MeshBones::number(const std::string& name, const NodeMatrix& inverse_bind) {
    auto& bones = mesh_.skin.bones;
    const MeshBone bone{bone_name(name), rows_of(inverse_bind, scale_)};
    const auto found = std::ranges::find(bones, bone);
    if (found != bones.end())
        return static_cast<uint32_t>(found - bones.begin());
    bones.push_back(bone);
    return static_cast<uint32_t>(bones.size() - 1);
}

NodeMatrix MeshBones::placement(const aiMesh& mesh) const {
    const aiBone* top = nullptr;
    const aiNode* at = nullptr;
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiNode* node = scene_.mRootNode->FindNode(mesh.mBones[b]->mName);
        if (node && (!at || depth_of(node) < depth_of(at))) {
            top = mesh.mBones[b];
            at = node;
        }
    }
    if (!top)
        return {};
    const NodeMatrix place = world_of(*at) * NodeMatrix(top->mOffsetMatrix);
    const bool good = std::abs(place.Determinant()) > 0 && !near(place, NodeMatrix());
    return good ? place : NodeMatrix();
}

Status MeshBones::gather(const aiMesh& mesh, const NodeMatrix& to_world,
                         std::pmr::vector<Influence>& influences) {
    const NodeMatrix back = NodeMatrix(to_world).Inverse();
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const uint32_t index = number(bone.mName.C_Str(), NodeMatrix(bone.mOffsetMatrix) * back);
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const aiVertexWeight& of = bone.mWeights[w];
            const auto bad = [&](const std::string& text) {
                return Error{PLAIT_BAD_DATA,
                             format("%s: mesh \"%s\": bone \"%s\": %s", file_.c_str(),
                                    mesh.mName.C_Str(), bone.mName.C_Str(), text.c_str())};
            };
            if (of.mVertexId >= mesh.mNumVertices)
                return bad(format("moves vertex %u; allowed 0 to %u", of.mVertexId,
                                  mesh.mNumVertices - 1));
            if (!(of.mWeight >= 0) || !std::isfinite(of.mWeight))
                return bad(format("weight of vertex %u is %g; allowed 0 or more", of.mVertexId,
                                  double(of.mWeight)));
            if (of.mWeight > 0)
                influences.push_back({of.mVertexId, index, of.mWeight});
        }
    }
    return {};
}

// The four of most weight of each vertex.
void MeshBones::reduce(const aiMesh& mesh, std::span<const Influence> influences,
                       uint32_t first_bone, std::pmr::vector<VertexSkin>& skins) {
    const auto note = [&](uint32_t vertex, const std::string& what) {
        if (mesh_.skins_reduced++ == 0)
            mesh_.first_reduced =
                format("mesh \"%s\", vertex %u: %s", mesh.mName.C_Str(), vertex, what.c_str());
    };
    size_t next = 0;
    for (uint32_t vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
        size_t count = 0;
        VertexSkin& skin = skins[vertex];
        for (; next < influences.size() && influences[next].vertex == vertex; ++next, ++count)
            if (count < 4) {
                skin.indices[count] = influences[next].bone;
                skin.weights[count] = influences[next].weight;
            }
        if (count > 4)
            note(vertex, format("%zu bones, the four of most weight kept", count));
        if (count == 0) {
            note(vertex, "no bone, the mesh's first taken");
            skin = {{first_bone, 0, 0, 0}, {1, 0, 0, 0}};
        }
        skin.weights = normalized(skin.weights);
    }
}

Result<NodeMatrix> MeshBones::take(const aiMesh& mesh, const aiNode& node,
                                   std::pmr::vector<VertexSkin>& skins) {
    if (!any_)
        return world_of(node);
    skins.assign(mesh.mNumVertices, {});
    if (!mesh.HasBones()) {
        const NodeMatrix to_world = world_of(node);
        const uint32_t bone = number(node.mName.C_Str(), inverse_or_identity(to_world));
        skins.assign(mesh.mNumVertices, {{bone, 0, 0, 0}, {1, 0, 0, 0}});
        return to_world;
    }
    const NodeMatrix to_world = placement(mesh);
    std::pmr::vector<Influence> influences(skins.get_allocator().resource());
    PLAIT_TRY(gather(mesh, to_world, influences));
    std::ranges::stable_sort(influences, [](const Influence& a, const Influence& b) {
        return a.vertex != b.vertex ? a.vertex < b.vertex : a.weight > b.weight;
    });
    const uint32_t first_bone =
        number(mesh.mBones[0]->mName.C_Str(),
               NodeMatrix(mesh.mBones[0]->mOffsetMatrix) * NodeMatrix(to_world).Inverse());
    reduce(mesh, influences, first_bone, skins);
    return to_world;
}

} // namespace plait
