// The bones of a file's meshes, as assimp has them, in one list, and which of them move which vertices.
#pragma once

#include "base/result.hpp"
#include "core/mesh/mesh.hpp"

#include <assimp/scene.h>

namespace plait {

using NodeMatrix = aiMatrix4x4t<double>;

struct VertexSkin {
    BoneIndices indices{};
    BoneWeights weights{};
};

class MeshBones {
  public:
    // Bones go to mesh.skin.bones, what is chosen among them is counted in `mesh`.
    MeshBones(const std::string& file, const aiScene& scene, float scale, RawMesh& mesh);

    // Some mesh of the scene has bones: then all vertices get a skin.
    bool any() const { return any_; }

    // Skins of the vertices of a mesh at a node, and where its vertices are put. A mesh without bones
    // goes with its node. One with bones is by glTF's rules where these are, wherever its node is: it
    // is put so that its topmost bone is at rest where its node is.
    Result<NodeMatrix> take(const aiMesh& mesh, const aiNode& node,
                            std::pmr::vector<VertexSkin>& skins);

  private:
    struct Influence {
        uint32_t vertex, bone;
        float weight;
    };

    uint32_t number(const std::string& name, const NodeMatrix& inverse_bind);
    NodeMatrix placement(const aiMesh& mesh) const;
    Status gather(const aiMesh& mesh, const NodeMatrix& to_world,
                  std::pmr::vector<Influence>& influences);
    void reduce(const aiMesh& mesh, std::span<const Influence> influences, uint32_t first_bone,
                std::pmr::vector<VertexSkin>& skins);

    const std::string& file_;
    const aiScene& scene_;
    double scale_;
    RawMesh& mesh_;
    bool any_ = false;
};

// From a node's frame to the file's.
NodeMatrix world_of(const aiNode& node);

} // namespace plait
