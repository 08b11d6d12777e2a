// Faces of OBJ and glTF through assimp, which gives every corner of a face a vertex of its own where
// normals or texture coordinates differ, or always: those at one place that the same bones move are
// joined again.
#include "base/hash.hpp"
#include "io/assimp.hpp"
#include "io/file.hpp"
#include "io/formats.hpp"
#include "io/mesh_bones.hpp"
#include "io/obj_check.hpp"
#include "io/words.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <exception>
#include <new>
#include <unordered_map>

namespace plait {
namespace {

constexpr std::string_view OBJ_IMPORTER[] = {"Wavefront Object Importer"};
constexpr std::string_view GLTF_IMPORTERS[] = {"glTF Importer", "glTF2 Importer"};

// A vertex: where it is, and what moves it.
struct Corner {
    MeshPoint at{};
    BoneIndices indices{};
    BoneWeights weights{};
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    size_t operator()(const Corner& corner) const {
        Hash hash;
        for (const float c : corner.at)
            hash.add(c + 0.0f); // -0 is 0
        for (const uint32_t bone : corner.indices)
            hash.add(bone);
        return static_cast<size_t>(hash.value());
    }
};

class Collector {
  public:
    Collector(const std::string& file, const aiScene& scene, const ReadOptions& options)
        : file_(file), scene_(scene), scale_(options.scale), found_(options.memory),
          bones_(file, scene, options.scale, found_), skins_(options.memory),
          number_(options.memory) {}

    // All meshes where the nodes put them.
    Status collect() {
        std::pmr::vector<const aiNode*> left({scene_.mRootNode}, skins_.get_allocator().resource());
        while (!left.empty()) {
            const aiNode* const node = left.back();
            left.pop_back();
            if (!node)
                continue;
            for (unsigned m = 0; m < node->mNumMeshes; ++m) {
                const aiMesh& mesh = *scene_.mMeshes[node->mMeshes[m]];
                const auto to_world = bones_.take(mesh, *node, skins_);
                PLAIT_TRY(to_world);
                PLAIT_TRY(append(mesh, *to_world));
            }
            for (unsigned c = node->mNumChildren; c-- > 0;)
                left.push_back(node->mChildren[c]);
        }
        return {};
    }

    Result<RawMesh> take() {
        if (found_.surface.triangles.empty())
            return Error{PLAIT_BAD_DATA, format("%s: has no faces", file_.c_str())};
        return std::move(found_);
    }

  private:
    // Lines and points are left out. A node that mirrors turns faces inside out.
    Status append(const aiMesh& mesh, const NodeMatrix& to_world) {
        const bool mirrors = to_world.Determinant() < 0;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3)
                continue;
            Triangle triangle{};
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned index = face.mIndices[k];
                if (index >= mesh.mNumVertices)
                    return Error{PLAIT_BAD_DATA,
                                 format("%s: mesh \"%s\": face %u has vertex %u; allowed 0 to %u",
                                        file_.c_str(), mesh.mName.C_Str(), f, index,
                                        mesh.mNumVertices - 1)};
                const aiVector3D& v = mesh.mVertices[index];
                const aiVector3t<double> p =
                    to_world * aiVector3t<double>(double(v.x), double(v.y), double(v.z));
                triangle[mirrors ? 2 - k : k] =
                    vertex({{scale_ * static_cast<float>(p.x), scale_ * static_cast<float>(p.y),
                             scale_ * static_cast<float>(p.z)},
                            bones_.any() ? skins_[index].indices : BoneIndices{},
                            bones_.any() ? skins_[index].weights : BoneWeights{}});
            }
            found_.surface.triangles.push_back(triangle);
        }
        return {};
    }

    uint32_t vertex(const Corner& corner) {
        const auto next = static_cast<uint32_t>(found_.surface.positions.size());
        const auto [place, fresh] = number_.try_emplace(corner, next);
        if (!fresh)
            return place->second;
        found_.surface.positions.push_back(corner.at);
        if (bones_.any()) {
            found_.skin.indices.push_back(corner.indices);
            found_.skin.weights.push_back(corner.weights);
        }
        return next;
    }

    const std::string& file_;
    const aiScene& scene_;
    float scale_;
    RawMesh found_;
    MeshBones bones_;
    std::pmr::vector<VertexSkin> skins_; // of the mesh in hand
    std::pmr::unordered_map<Corner, uint32_t, CornerHash> number_;
};

// `read`(importer): the scene, or null.
template <typename Read>
Result<RawMesh> triangles_of(const std::string& file, const ReadOptions& options,
                             const Read& read) {
    try {
        Assimp::Importer importer;
        const aiScene* scene = read(importer);
        if (!scene)
            return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), importer.GetErrorString())};
        Collector collector(file, *scene, options);
        PLAIT_TRY(collector.collect());
        return collector.take();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // what assimp throws stops here
        return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), error.what())};
    }
}

} // namespace

Result<RawMesh> read_obj_mesh(const std::string& path, const ReadOptions& options) {
    auto text = read_file(path, options.memory);
    PLAIT_TRY(text);
    return read_obj_mesh(std::move(*text), path, options);
}

Result<RawMesh> read_obj_mesh(ByteVector text, const std::string& file,
                              const ReadOptions& options) {
    const std::string_view all(reinterpret_cast<const char*>(text.data()), text.size());
    const size_t mark = all.size() - after_mark(all).size();
    PLAIT_TRY(check_obj(all.substr(mark), file));
    text.erase(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(mark));
    text.push_back(std::byte{'\n'}); // without, assimp leaves out the last line of 16 MiB or more
    return triangles_of(file, options, [&](Assimp::Importer& importer) {
        keep_importers(importer, OBJ_IMPORTER);
        importer.SetIOHandler(new NoOtherFiles); // which is the importer's now
        return importer.ReadFileFromMemory(text.data(), text.size(), aiProcess_Triangulate, "obj");
    });
}

// By its path: buffers lie in files beside it.
Result<RawMesh> read_gltf_mesh(const std::string& path, const ReadOptions& options) {
    PLAIT_TRY(check_file(path));
    return triangles_of(path, options, [&](Assimp::Importer& importer) {
        keep_importers(importer, GLTF_IMPORTERS);
        return importer.ReadFile(path, aiProcess_Triangulate);
    });
}

} // namespace plait
