#include "head_mesh.hpp"
#include "common.hpp"
#include "read_field.hpp"

#include "generator/generator.hpp"

#include <algorithm>

#ifdef PLAIT_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

namespace simulate {

namespace {

HeadMesh read_tfxmesh(const std::string& file) {
    plait_mesh* mesh = nullptr;
    check(plait_mesh_load(file.c_str(), nullptr, &mesh));
    return shape_of(MeshHandle(mesh).get());
}

#ifdef PLAIT_WITH_ASSIMP
void append(HeadMesh& head, const aiMesh& mesh) {
    const auto first = static_cast<uint32_t>(head.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
        head.vertices.emplace_back(mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        if (const aiFace& face = mesh.mFaces[f]; face.mNumIndices == 3)
            head.triangles.push_back(
                {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
}

HeadMesh read_by_assimp(const std::string& file) {
    Assimp::Importer importer;
    // Only positions matter: without normals and texture coordinates vertices join across seams.
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                                aiComponent_NORMALS | aiComponent_TEXCOORDS | aiComponent_COLORS);
    const aiScene* scene = importer.ReadFile(
        file, aiProcess_Triangulate | aiProcess_RemoveComponent | aiProcess_JoinIdenticalVertices |
                  aiProcess_PreTransformVertices);
    if (!scene)
        throw Failure(file + ": " + importer.GetErrorString());
    HeadMesh head;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m)
        append(head, *scene->mMeshes[m]);
    return head;
}
#else
HeadMesh read_by_assimp(const std::string& file) {
    throw Failure(file + ": this plait-simulate was built without assimp and reads .tfxmesh only");
}
#endif

} // namespace

// Where hair grows the skin is hidden by it, also by the hairs that so few strands stand for: the
// mannequin's is drawn in their colour, and fades over this height above the hairline, m.
constexpr float hairline = 0.010f;

std::vector<float> scalp_of(const std::vector<Eigen::Vector3f>& vertices) {
    std::vector<float> scalp;
    for (const Eigen::Vector3f& p : vertices) {
        const float low = static_cast<float>(
            plait_generator::scalp_height(double(p.x()), double(p.y()), double(p.z())));
        scalp.push_back(0.9f * std::clamp(low / hairline, 0.0f, 1.0f));
    }
    return scalp;
}

namespace {

HeadMesh without_scalp(const plait_generator::HeadMesh& made) {
    HeadMesh head;
    for (size_t v = 0; v < made.positions.size(); v += 3)
        head.vertices.emplace_back(made.positions[v], made.positions[v + 1], made.positions[v + 2]);
    for (size_t t = 0; t < made.triangles.size(); t += 3)
        head.triangles.push_back({made.triangles[t], made.triangles[t + 1], made.triangles[t + 2]});
    return head;
}

} // namespace

HeadMesh mannequin() {
    HeadMesh head = without_scalp(plait_generator::make_head(2));
    head.scalp = scalp_of(head.vertices);
    return head;
}

HeadMesh ball(bool fur) {
    HeadMesh head = without_scalp(plait_generator::make_ball());
    for (const Eigen::Vector3f& p : head.vertices) {
        const float high = p.y() - static_cast<float>(plait_generator::ball_hairline);
        head.scalp.push_back(fur ? 0.9f : 0.9f * std::clamp(high / hairline, 0.0f, 1.0f));
    }
    return head;
}

HeadMesh shape_of(const plait_mesh* mesh) {
    HeadMesh head;
    for (const auto& p : read_field<std::array<float, 3>>(mesh, PLAIT_MESH_FIELD_POSITIONS))
        head.vertices.emplace_back(p[0], p[1], p[2]);
    head.triangles = read_field<std::array<uint32_t, 3>>(mesh, PLAIT_MESH_FIELD_TRIANGLES);
    return head;
}

HeadMesh load_head(const std::string& file, float scale) {
    HeadMesh head = file.ends_with(".tfxmesh") ? read_tfxmesh(file) : read_by_assimp(file);
    if (head.triangles.empty())
        throw Failure(file + ": no triangles");
    for (Eigen::Vector3f& vertex : head.vertices)
        vertex *= scale;
    return head;
}

} // namespace simulate
