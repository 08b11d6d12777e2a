#include "io/io.hpp"

#include "base/path.hpp"
#include "io/curves/save.hpp"
#include "io/extension.hpp"
#include "io/file.hpp"
#include "io/formats.hpp"

#include <algorithm>
#include <new>

namespace plait {
namespace {

std::string skin_path(const std::string& path) {
    return utf8_path(native_path(path).replace_extension(".tfxbone"));
}

Status read_skin_beside(const std::string& path, StrandSet& strands) {
    const std::string beside = skin_path(path);
    const Status there = check_file(beside);
    if (there.error().code == PLAIT_NOT_FOUND)
        return {};
    PLAIT_TRY(there);
    auto bytes = read_file(beside, strands.positions.get_allocator().resource());
    PLAIT_TRY(bytes);
    return read_tfxbone({*bytes, beside}, strands);
}

Result<StrandSet> read_tfx_file(const std::string& path, const ReadOptions& options) {
    auto bytes = read_file(path, options.memory);
    PLAIT_TRY(bytes);
    auto strands = read_tfx({*bytes, path}, options);
    PLAIT_TRY(strands);
    PLAIT_TRY(read_skin_beside(path, *strands));
    return strands;
}

// Formats that people have hair in, and what makes of them one that is read.
constexpr struct Refused {
    const char *extension, *what, *instead;
} REFUSED[] = {
    {".npz", "arrays of NumPy, which do not say what they are",
     "write .data, or give the arrays to plait_groom_create"},
    {".npy", "an array of NumPy, which does not say what it is",
     "write .data, or give the array to plait_groom_create"},
    {".ma", "a scene of Maya", "export its curves as Alembic, in Maya: Cache, Alembic Cache"},
    {".mb", "a scene of Maya", "export its curves as Alembic, in Maya: Cache, Alembic Cache"},
    {".blend", "a scene of Blender", "export its curves as Alembic (.abc) or USD (.usda)"},
    {".bgeo", "geometry of Houdini", "export its curves as Alembic (.abc) or USD (.usda)"}};

using ReadBytes = Result<StrandSet> (*)(const ByteReader& file, const ReadOptions& options);

Result<StrandSet> read_whole(const std::string& path, const ReadOptions& options, ReadBytes read) {
    auto bytes = read_file(path, options.memory);
    PLAIT_TRY(bytes);
    return read({*bytes, path}, options);
}

Result<StrandSet> read_by_extension(const std::string& path, const ReadOptions& options) {
    const std::string extension = extension_of(path);
    const bool of_curves = extension == ".abc" || extension.starts_with(".usd");
    if (options.part != StrandPart::ALL && !of_curves)
        return Error{PLAIT_UNSUPPORTED,
                     format("%s: \"%s\" does not tell guides from other strands; "
                            ".abc and .usda do",
                            path.c_str(), extension.c_str())};
    if (extension == ".tfx")
        return read_tfx_file(path, options);
    if (extension == ".hair")
        return read_whole(path, options, read_hair);
    if (extension == ".abc")
        return read_whole(path, options, read_alembic);
    if (extension == ".usda" || extension == ".usd")
        return read_whole(path, options, read_usd);
    if (extension == ".obj")
        return read_polylines(path, options);
    if (extension == ".ply")
        return read_whole(path, options, read_ply);
    if (extension == ".data")
        return read_whole(path, options, read_strand_data);
    if (extension == ".usdc" || extension == ".usdz")
        return usd_not_text(path, extension == ".usdc" ? "binary" : "an archive");
    for (const Refused& refused : REFUSED)
        if (extension == refused.extension)
            return Error{PLAIT_UNSUPPORTED, format("%s: is %s, which is not read; %s", path.c_str(),
                                                   refused.what, refused.instead)};
    return Error{
        PLAIT_UNSUPPORTED,
        format("%s: cannot read strands from \"%s\"; known are .tfx, .hair, .obj, .abc, .usda, "
               ".ply, .data",
               path.c_str(), extension.c_str())};
}

Result<RawMesh> read_tfxmesh_file(const std::string& path, const ReadOptions& options) {
    auto bytes = read_file(path, options.memory);
    PLAIT_TRY(bytes);
    return read_tfxmesh({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path,
                        options);
}

Result<RawMesh> read_mesh_by_extension(const std::string& path, const ReadOptions& options) {
    const std::string extension = extension_of(path);
    if (extension == ".obj")
        return read_obj_mesh(path, options);
    if (extension == ".gltf" || extension == ".glb")
        return read_gltf_mesh(path, options);
    if (extension == ".tfxmesh")
        return read_tfxmesh_file(path, options);
    return Error{PLAIT_UNSUPPORTED,
                 format("%s: cannot read a mesh from \"%s\"; known are .obj, .gltf, .glb, "
                        ".tfxmesh",
                        path.c_str(), extension.c_str())};
}

// The result of writing to memory, with the name of the file it is for.
Result<ByteVector> for_file(const std::string& path, Result<ByteVector> bytes) {
    if (bytes)
        return bytes;
    return Error{bytes.error().code, format("%s: %s", path.c_str(), bytes.error().message.c_str())};
}

Status write_hair_file(const std::string& path, const StrandSet& strands) {
    auto bytes = for_file(path, write_hair(strands));
    PLAIT_TRY(bytes);
    return write_file(path, *bytes);
}

// Nothing is written unless both files can be.
Status write_tfx_file(const std::string& path, const StrandSet& strands) {
    auto bytes = for_file(path, write_tfx(strands));
    PLAIT_TRY(bytes);
    if (!strands.bone_indices.empty()) {
        auto skin = for_file(skin_path(path), write_tfxbone(strands));
        PLAIT_TRY(skin);
        PLAIT_TRY(write_file(skin_path(path), *skin));
    }
    return write_file(path, *bytes);
}

Status write_by_extension(const std::string& path, const StrandSet& strands) {
    const std::string extension = extension_of(path);
    if (extension == ".tfx")
        return write_tfx_file(path, strands);
    if (extension == ".hair")
        return write_hair_file(path, strands);
    if (extension == ".abc" || extension == ".usda")
        return save_curves(path, strands);
    return Error{PLAIT_UNSUPPORTED,
                 format("%s: cannot write strands to \"%s\"; known are .tfx, .hair, .abc, .usda",
                        path.c_str(), extension.c_str())};
}

Error out_of_memory(const std::string& path) {
    return {PLAIT_OUT_OF_MEMORY, format("%s: host memory is exhausted", path.c_str())};
}

} // namespace

Result<StrandSet> read_strands(const std::string& path, const ReadOptions& options) {
    try {
        return read_by_extension(path, options);
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

Status write_strands(const std::string& path, const StrandSet& strands) {
    try {
        return write_by_extension(path, strands);
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

Result<RawMesh> read_mesh(const std::string& path, const ReadOptions& options) {
    try {
        return read_mesh_by_extension(path, options);
    } catch (const std::bad_alloc&) {
        return out_of_memory(path);
    }
}

} // namespace plait
