#include "meshes.hpp"

#include "common/json_reader.hpp"
#include "generator/generator.hpp"

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

constexpr const char* form_names[] = {"field", "nearest", "hull"}; // as plait_mesh_form, then that
constexpr int hull_form = 2;

} // namespace

void read_mesh(JsonReader& in, const std::string& folder, MeshChoice& mesh) {
    mesh.place = in.place("file");
    if (!in.text("file", mesh.file))
        in.fail("file", "is missing: an .obj, .gltf, .glb or .tfxmesh");
    mesh.file = (std::filesystem::path(folder) / mesh.file).string();
    int form = static_cast<int>(mesh.desc.form);
    in.choice("form", form, form_names);
    mesh.hull = form == hull_form;
    if (!mesh.hull)
        mesh.desc.form = static_cast<plait_mesh_form>(form);
    else
        in.number("tolerance", mesh.tolerance, 1e-6, 0.1);
    in.number("scale", mesh.scale, 1e-6, 1e6);
    in.number("margin", mesh.desc.margin, 0, 0.05);
    in.number("friction", mesh.desc.friction, 0, 10);
    if (in.integer("cells", mesh.desc.cells, 8, 256) && form != PLAIT_MESH_FORM_FIELD)
        in.fail("cells", std::string("is given, and form ") + form_names[form] +
                             ", too: only a field has cells");
    bool two_sided = false;
    in.flag("two_sided", two_sided);
    if (two_sided && mesh.hull)
        in.fail("two_sided", "is given, and form hull, too, which always has an inside");
    mesh.desc.two_sided = two_sided ? 1 : 0;
    in.flag("drawn", mesh.drawn);
}

std::vector<MeshChoice> read_meshes(JsonReader& top, const std::string& folder) {
    std::vector<MeshChoice> list;
    top.each("meshes", [&](JsonReader in) {
        MeshChoice mesh;
        read_mesh(in, folder, mesh);
        in.flag("moves_with_head", mesh.moves_with_head);
        in.finish();
        list.push_back(std::move(mesh));
    });
    return list;
}

LoadedMesh load_mesh(const MeshChoice& choice, bool generated) {
    MeshHandle mesh = load(choice);
    HeadMesh shape = shape_of(mesh.get());
    if (generated && choice.moves_with_head)
        shape.scalp = scalp_of(shape.vertices);
    return {std::move(mesh), choice, std::move(shape), choice.moves_with_head ? 1.0f : 0.0f};
}

std::vector<LoadedMesh> load_meshes(const std::vector<MeshChoice>& choices, bool generated) {
    std::vector<LoadedMesh> list;
    for (const MeshChoice& choice : choices)
        list.push_back(load_mesh(choice, generated));
    return list;
}

namespace {

LoadedMesh mannequin_part(const plait_generator::HeadMesh& made, float head_share) {
    plait_mesh_desc desc = plait_mesh_desc_defaults();
    desc.positions = {made.positions.data(), made.positions.size() / 3, 0};
    desc.triangles = {made.triangles.data(), made.triangles.size() / 3, 0};
    plait_mesh* mesh = nullptr;
    check(plait_mesh_create(&desc, nullptr, &mesh));
    MeshChoice choice;
    choice.place = "the mannequin";
    choice.drawn = false;
    choice.moves_with_head = head_share > 0;
    return {MeshHandle(mesh), choice, shape_of(mesh), head_share};
}

} // namespace

std::vector<LoadedMesh> mannequin_parts() {
    const plait_generator::HeadParts parts = plait_generator::make_head_parts();
    std::vector<LoadedMesh> list;
    list.push_back(mannequin_part(parts.head, 1));
    list.push_back(mannequin_part(parts.neck, 0.5f));
    list.push_back(mannequin_part(parts.torso, 0));
    return list;
}

} // namespace simulate
