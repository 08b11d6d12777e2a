// Faces of OBJ and glTF through assimp, which gives every corner of a face a vertex of its own where
// normals or texture coordinates differ, or always: those at one place are joined again.
#include "base/hash.hpp"
#include "io/assimp.hpp"
#include "io/file.hpp"
#include "io/formats.hpp"
#include "io/obj_check.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <exception>
#include <new>
#include <unordered_map>

namespace plait {
namespace {

constexpr std::string_view OBJ_IMPORTER[] = {"Wavefront Object Importer"};
constexpr std::string_view GLTF_IMPORTERS[] = {"glTF Importer", "glTF2 Importer"};

struct PointHash {
    size_t operator()(const MeshPoint& p) const {
        Hash hash;
        for (const float c : p)
            hash.add(c + 0.0f); // -0 is 0
        return static_cast<size_t>(hash.value());
    }
};

class Collector {
  public:
    Collector(const std::string& file, const ReadOptions& options)
        : file_(file), scale_(options.scale), found_(options.memory), number_(options.memory) {}

    // All meshes where the nodes put them.
    Status collect(const aiScene& scene) {
        struct Place {
            const aiNode* node;
            aiMatrix4x4 to_world;
        };
        std::pmr::vector<Place> left({{scene.mRootNode, {}}}, number_.get_allocator().resource());
        while (!left.empty()) {
            const Place place = left.back();
            left.pop_back();
            if (!place.node)
                continue;
            const aiMatrix4x4 to_world = place.to_world * place.node->mTransformation;
            for (unsigned m = 0; m < place.node->mNumMeshes; ++m)
                PLAIT_TRY(append(*scene.mMeshes[place.node->mMeshes[m]], to_world));
            for (unsigned c = place.node->mNumChildren; c-- > 0;)
                left.push_back({place.node->mChildren[c], to_world});
        }
        return {};
    }

    Result<TriangleSet> take() {
        if (found_.triangles.empty())
            return Error{PLAIT_BAD_DATA, format("%s: has no faces", file_.c_str())};
        return std::move(found_);
    }

  private:
    // Lines and points are left out. A node that mirrors turns faces inside out.
    Status append(const aiMesh& mesh, const aiMatrix4x4& to_world) {
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
                triangle[mirrors ? 2 - k : k] = vertex(to_world * mesh.mVertices[index]);
            }
            found_.triangles.push_back(triangle);
        }
        return {};
    }

    uint32_t vertex(const aiVector3D& p) {
        const MeshPoint at{scale_ * p.x, scale_ * p.y, scale_ * p.z};
        const auto next = static_cast<uint32_t>(found_.positions.size());
        const auto [place, fresh] = number_.try_emplace(at, next);
        if (fresh)
            found_.positions.push_back(at);
        return place->second;
    }

    const std::string& file_;
    float scale_;
    TriangleSet found_;
    std::pmr::unordered_map<MeshPoint, uint32_t, PointHash> number_;
};

// `read`(importer): the scene, or null.
template <typename Read>
Result<TriangleSet> triangles_of(const std::string& file, const ReadOptions& options,
                                 const Read& read) {
    try {
        Assimp::Importer importer;
        const aiScene* scene = read(importer);
        if (!scene)
            return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), importer.GetErrorString())};
        Collector collector(file, options);
        PLAIT_TRY(collector.collect(*scene));
        return collector.take();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // what assimp throws stops here
        return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), error.what())};
    }
}

} // namespace

Result<TriangleSet> read_obj_mesh(const std::string& path, const ReadOptions& options) {
    auto text = read_file(path, options.memory);
    PLAIT_TRY(text);
    return read_obj_mesh(std::move(*text), path, options);
}

Result<TriangleSet> read_obj_mesh(ByteVector text, const std::string& file,
                                  const ReadOptions& options) {
    PLAIT_TRY(check_obj({reinterpret_cast<const char*>(text.data()), text.size()}, file));
    text.push_back(std::byte{'\n'}); // without, assimp leaves out the last line of 16 MiB or more
    return triangles_of(file, options, [&](Assimp::Importer& importer) {
        keep_importers(importer, OBJ_IMPORTER);
        importer.SetIOHandler(new NoOtherFiles); // which is the importer's now
        return importer.ReadFileFromMemory(text.data(), text.size(), aiProcess_Triangulate, "obj");
    });
}

// By its path: buffers lie in files beside it.
Result<TriangleSet> read_gltf_mesh(const std::string& path, const ReadOptions& options) {
    PLAIT_TRY(check_file(path));
    return triangles_of(path, options, [&](Assimp::Importer& importer) {
        keep_importers(importer, GLTF_IMPORTERS);
        return importer.ReadFile(path, aiProcess_Triangulate);
    });
}

} // namespace plait
