#include "fuzz.hpp"

using namespace plait;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    auto mesh = read_tfxmesh({reinterpret_cast<const char*>(data), size}, "input.tfxmesh", {});
    if (!mesh)
        return 0;
    const size_t vertices = mesh->surface.positions.size();
    fuzz::demand(vertices + mesh->surface.triangles.size() + mesh->skin.bones.size() <= size,
                 "no more elements than bytes");
    for (const Triangle& triangle : mesh->surface.triangles)
        for (const uint32_t corner : triangle)
            fuzz::demand(corner < vertices, "corners are vertices");
    fuzz::demand(mesh->skin.indices.size() == (mesh->skin.bones.empty() ? 0 : vertices) &&
                     mesh->skin.weights.size() == mesh->skin.indices.size(),
                 "with bones all vertices have some");
    for (const BoneIndices& indices : mesh->skin.indices)
        for (const uint32_t bone : indices)
            fuzz::demand(bone < mesh->skin.bones.size(), "what moves them are bones");
    return 0;
}
