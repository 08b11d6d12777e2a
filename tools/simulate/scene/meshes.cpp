#include "meshes.hpp"

#include <filesystem>

namespace simulate {

namespace {

MeshHandle load(const MeshChoice& choice) {
    plait_import_options options = plait_import_options_defaults();
    options.scale = choice.scale;
    plait_mesh* mesh = nullptr;
    if (plait_mesh_load(choice.file.c_str(), &options, &mesh) != PLAIT_OK)
        throw Failure(choice.place + ": " + plait_last_error());
    return MeshHandle(mesh);
}

template <typename T> std::vector<T> read_field(const plait_mesh* mesh, plait_mesh_field field) {
    size_t size = 0;
    check(plait_mesh_read(mesh, field, nullptr, &size));
    std::vector<T> data(size / sizeof(T));
    check(plait_mesh_read(mesh, field, data.data(), &size));
    return data;
}

HeadMesh drawn(const plait_mesh* mesh, bool has_scalp) {
    HeadMesh head;
    for (const auto& p : read_field<std::array<float, 3>>(mesh, PLAIT_MESH_FIELD_POSITIONS))
        head.vertices.emplace_back(p[0], p[1], p[2]);
    head.triangles = read_field<std::array<uint32_t, 3>>(mesh, PLAIT_MESH_FIELD_TRIANGLES);
    if (has_scalp)
        head.scalp = scalp_of(head.vertices);
    return head;
}

} // namespace

std::vector<MeshChoice> read_meshes(JsonReader& top, const std::string& folder) {
    std::vector<MeshChoice> list;
    top.each("meshes", [&](JsonReader in) {
        MeshChoice mesh;
        mesh.place = in.place("file");
        if (!in.text("file", mesh.file))
            in.fail("file", "is missing: an .obj, .gltf or .glb");
        mesh.file = (std::filesystem::path(folder) / mesh.file).string();
        in.number("scale", mesh.scale, 1e-6, 1e6);
        in.number("margin", mesh.desc.margin, 0, 0.05);
        in.number("friction", mesh.desc.friction, 0, 10);
        in.integer("cells", mesh.desc.cells, 8, 256);
        bool two_sided = false;
        in.flag("two_sided", two_sided);
        mesh.desc.two_sided = two_sided ? 1 : 0;
        in.flag("moves_with_head", mesh.moves_with_head);
        in.finish();
        list.push_back(std::move(mesh));
    });
    return list;
}

std::vector<LoadedMesh> load_meshes(const std::vector<MeshChoice>& choices, bool generated) {
    std::vector<LoadedMesh> list;
    for (const MeshChoice& choice : choices) {
        MeshHandle mesh = load(choice);
        HeadMesh shape = drawn(mesh.get(), generated && choice.moves_with_head);
        list.push_back({std::move(mesh), choice, std::move(shape)});
    }
    return list;
}

} // namespace simulate
