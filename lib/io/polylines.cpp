// Polylines of OBJ (`l`) through assimp, which hands every polyline over as a run of two-vertex
// faces: a run is a strand for as long as each segment starts where the one before it ended.
#include "io/assimp.hpp"
#include "io/file.hpp"
#include "io/formats.hpp"
#include "io/obj_check.hpp"

#include <assimp/scene.h>

#include <exception>
#include <new>
#include <string_view>

namespace plait {
namespace {

void push_vertex(StrandSet& strands, const aiVector3D& p, float scale) {
    for (float value : {p.x, p.y, p.z})
        strands.positions.push_back(scale * value);
    ++strands.vertex_counts.back();
}

Status append_mesh(const std::string& file, const aiMesh& mesh, float scale, StrandSet& strands) {
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
            push_vertex(strands, mesh.mVertices[first], scale);
        }
        push_vertex(strands, mesh.mVertices[second], scale);
        end = &face.mIndices[1];
    }
    return {};
}

Result<StrandSet> strands_of(const std::string& file, const aiScene& scene,
                             const ReadOptions& options) {
    StrandSet strands(options.memory);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        PLAIT_TRY(append_mesh(file, *scene.mMeshes[m], options.scale, strands));
    if (strands.vertex_counts.empty())
        return Error{PLAIT_BAD_DATA, format("%s: has no polylines", file.c_str())};
    return strands;
}

constexpr std::string_view OBJ_IMPORTER[] = {"Wavefront Object Importer"};

} // namespace

Result<StrandSet> read_polylines(const std::string& path, const ReadOptions& options) {
    auto text = read_file(path, options.memory);
    PLAIT_TRY(text);
    return read_polylines(std::move(*text), path, options);
}

Result<StrandSet> read_polylines(ByteVector text, const std::string& file,
                                 const ReadOptions& options) {
    PLAIT_TRY(check_obj({reinterpret_cast<const char*>(text.data()), text.size()}, file));
    text.push_back(std::byte{'\n'}); // without, assimp leaves out the last line of 16 MiB or more
    try {
        Assimp::Importer importer;
        keep_importers(importer, OBJ_IMPORTER);
        importer.SetIOHandler(new NoOtherFiles); // which is the importer's now
        const aiScene* scene = importer.ReadFileFromMemory(text.data(), text.size(), 0, "obj");
        if (!scene)
            return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), importer.GetErrorString())};
        return strands_of(file, *scene, options);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) { // what assimp throws stops here
        return Error{PLAIT_BAD_DATA, format("%s: %s", file.c_str(), error.what())};
    }
}

} // namespace plait
