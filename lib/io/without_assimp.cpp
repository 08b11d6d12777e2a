// What stands in for meshes.cpp when plait is built without assimp.
#include "io/formats.hpp"

namespace plait {
namespace {

Error needs_assimp(const std::string& file, const char* what) {
    return {PLAIT_UNSUPPORTED, format("%s: %s need assimp, which this build of plait is without "
                                      "(configure with -DPLAIT_ASSIMP=ON)",
                                      file.c_str(), what)};
}

} // namespace

Result<RawMesh> read_obj_mesh(const std::string& path, const ReadOptions&) {
    return needs_assimp(path, "meshes");
}

Result<RawMesh> read_obj_mesh(ByteVector, const std::string& file, const ReadOptions&) {
    return needs_assimp(file, "meshes");
}

Result<RawMesh> read_gltf_mesh(const std::string& path, const ReadOptions&) {
    return needs_assimp(path, "meshes");
}

} // namespace plait
