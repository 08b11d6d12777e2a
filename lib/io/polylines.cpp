// Polylines of OBJ (`l`) and glTF (line modes) through assimp, which hands every polyline over as
// a run of two-vertex faces: a run is a strand for as long as each segment starts where the one
// before it ended.
#include "io/file.hpp"
#include "io/formats.hpp"

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include <exception>
#include <memory>
#include <new>
#include <string_view>

namespace plait {
namespace {

void push_vertex(StrandSet& strands, const aiVector3D& p, float scale) {
    for (float value : {p.x, p.y, p.z})
        strands.positions.push_back(scale * value);
    ++strands.vertex_counts.back();
}

// Appends the strands of one mesh as the node's transform places it.
Status append_mesh(const std::string& file, const aiMesh& mesh, const aiMatrix4x4& placement,
                   float scale, StrandSet& strands) {
    const unsigned* end = nullptr; // index of the last vertex of the strand being built
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 2)
            continue;
        const unsigned first = face.mIndices[0], second = face.mIndices[1];
        if (first >= mesh.mNumVertices || second >= mesh.mNumVertices)
            return Error{
                PLAIT_BAD_DATA,
                format("%s: mesh \"%s\": line %u joins vertices %u and %u; allowed 0 to %u",
                       file.c_str(), mesh.mName.C_Str(), f, first, second, mesh.mNumVertices - 1)};
        if (!end || (*end != first && mesh.mVertices[*end] != mesh.mVertices[first])) {
            strands.vertex_counts.push_back(0);
            push_vertex(strands, placement * mesh.mVertices[first], scale);
        }
        push_vertex(strands, placement * mesh.mVertices[second], scale);
        end = &face.mIndices[1];
    }
    return {};
}

struct Placed {
    const aiNode* node;
    aiMatrix4x4 parent;
};

Result<StrandSet> strands_of(const std::string& file, const aiScene& scene,
                             const ReadOptions& options) {
    StrandSet strands(options.memory);
    std::vector<Placed> waiting = {{scene.mRootNode, aiMatrix4x4()}};
    while (!waiting.empty()) {
        const Placed placed = waiting.back();
        waiting.pop_back();
        const aiMatrix4x4 placement = placed.parent * placed.node->mTransformation;
        for (unsigned m = 0; m < placed.node->mNumMeshes; ++m)
            PLAIT_TRY(append_mesh(file, *scene.mMeshes[placed.node->mMeshes[m]], placement,
                                  options.scale, strands));
        for (unsigned c = placed.node->mNumChildren; c-- > 0;)
            waiting.push_back({placed.node->mChildren[c], placement});
    }
    if (strands.vertex_counts.empty())
        return Error{PLAIT_BAD_DATA, format("%s: has no polylines", file.c_str())};
    return strands;
}

// assimp shows a file that it does not know by its extension to all of its readers, and some of the
// old ones run out of bounds on the way: only those of OBJ and glTF 2 stay.
void keep_our_readers(Assimp::Importer& importer) {
    for (size_t i = importer.GetImporterCount(); i-- > 0;) {
        const std::string_view name = importer.GetImporterInfo(i)->mName;
        if (name == "Wavefront Object Importer" || name == "glTF2 Importer")
            continue;
        const std::unique_ptr<Assimp::BaseImporter> other(importer.GetImporter(i));
        importer.UnregisterLoader(other.get()); // which leaves it to us
    }
}

// `load(importer)` returns the scene or NULL. What assimp throws stops here.
template <typename Load>
Result<StrandSet> import(const std::string& file, const ReadOptions& options, Load load) {
    try {
        Assimp::Importer importer;
        keep_our_readers(importer);
        const aiScene* scene = load(importer);
        if (!scene || !scene->mRootNode)
            return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), importer.GetErrorString())};
        return strands_of(file, *scene, options);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), error.what())};
    }
}

} // namespace

Result<StrandSet> read_polylines(const std::string& path, const ReadOptions& options) {
    PLAIT_TRY(check_file(path));
    return import(path, options,
                  [&](Assimp::Importer& importer) { return importer.ReadFile(path, 0); });
}

Result<StrandSet> read_polylines(std::span<const std::byte> bytes, const std::string& extension,
                                 const ReadOptions& options) {
    return import("memory." + extension, options, [&](Assimp::Importer& importer) {
        return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str());
    });
}

} // namespace plait
