// Meshes.
#include "core/mesh/mesh.hpp"
#include "core/base/pose.hpp"
#include "core/mesh/mesh_fit.hpp"
#include "core/sim/import_frame.hpp"

#include "api/objects.hpp"
#include "api/options.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "io/io.hpp"

#include <plait/plait_offline.h>

namespace plait::api {
namespace {

template <typename T, size_t N> std::span<T> flat(std::pmr::vector<std::array<T, N>>& rows) {
    return {rows.empty() ? nullptr : rows.front().data(), N * rows.size()};
}

template <typename T, size_t N>
Status copy_rows(const plait_view& view, const char* name, std::pmr::vector<std::array<T, N>>& to) {
    std::pmr::vector<T> values(to.get_allocator().resource());
    PLAIT_TRY(copy_view(view, N, name, values));
    to.resize(view.count);
    std::ranges::copy(values, flat(to).begin());
    return {};
}

// All vertices have a skin, or none has.
Status copy_skin(const plait_mesh_desc& desc, MeshSkin& skin) {
    for (const auto& [count, name] : {std::pair{desc.bone_indices.count, "desc->bone_indices"},
                                      {desc.bone_weights.count, "desc->bone_weights"}})
        if (count != 0 && count != desc.positions.count)
            return invalid(format("%s.count is %zu, allowed is 0 or the %zu vertices", name, count,
                                  desc.positions.count));
    if (desc.bone_indices.count != desc.bone_weights.count)
        return invalid(format("desc->bone_indices.count is %zu, bone_weights.count is %zu: give "
                              "both or neither",
                              desc.bone_indices.count, desc.bone_weights.count));
    PLAIT_TRY(copy_rows(desc.bone_indices, "desc->bone_indices", skin.indices));
    return copy_rows(desc.bone_weights, "desc->bone_weights", skin.weights);
}

Result<RawMesh> copy_mesh(const plait_mesh_desc& desc, float scale, Memory* memory) {
    RawMesh mesh(memory);
    PLAIT_TRY(copy_rows(desc.positions, "desc->positions", mesh.surface.positions));
    PLAIT_TRY(copy_rows(desc.triangles, "desc->triangles", mesh.surface.triangles));
    PLAIT_TRY(copy_skin(desc, mesh.skin));
    for (float& coordinate : flat(mesh.surface.positions))
        coordinate *= scale;
    return mesh;
}

// Bones that know where they were bound would have to go along.
Status place_mesh(const plait_import_options& options, const std::string& where, RawMesh& raw) {
    const bool stays = options.axes == PLAIT_AXES_Y_UP && same_pose(options.pose, identity_pose);
    if (stays)
        return {};
    if (std::ranges::any_of(raw.skin.bones, [](const MeshBone& bone) {
            return bone.inverse_bind != MeshBone{}.inverse_bind;
        }))
        return Error{PLAIT_UNSUPPORTED,
                     format("%saxes and pose of the import are for meshes without a skin of glTF, "
                            "whose bones have places of their own",
                            where.c_str())};
    place_points(flat(raw.surface.positions), options.axes, options.pose);
    if (reflects(options.axes))
        for (Triangle& triangle : raw.surface.triangles)
            std::swap(triangle[0], triangle[2]);
    return {};
}

// Mends what `read` (a callable: memory -> Result<RawMesh>) gives and makes the handle.
template <typename Read>
Status make_mesh(const plait_import_options& options, const std::string& where, plait_mesh** out,
                 const Read& read) {
    Memory memory(options.allocator);
    auto handle = make_in<plait_mesh>(&memory, options.allocator);
    auto raw = read(&memory);
    if (!raw)
        return raw.error();
    PLAIT_TRY(place_mesh(options, where, *raw));
    PLAIT_TRY(build_mesh(*raw, options.policy, where, handle->mesh));
    *out = handle.release();
    return {};
}

plait_mesh_info describe(const Mesh& mesh) {
    plait_mesh_info info{};
    info.vertices = mesh.surface.positions.size();
    info.triangles = mesh.surface.triangles.size();
    info.open_edges = mesh.shape.open_edges;
    info.unsided_edges = mesh.shape.unsided_edges;
    info.components = mesh.shape.components;
    std::ranges::copy(mesh.shape.bounds_min, info.bounds_min);
    std::ranges::copy(mesh.shape.bounds_max, info.bounds_max);
    info.volume = mesh.shape.volume;
    info.area = mesh.shape.area;
    std::ranges::copy(mesh.repairs.count, info.repairs);
    info.repairs_total = mesh.repairs.total();
    mesh.repairs.first.copy(info.first_repair, sizeof info.first_repair - 1);
    info.bones = static_cast<uint32_t>(mesh.skin.bones.size());
    return info;
}

plait_mesh_bone_info bone_info(const MeshBone& bone) {
    plait_mesh_bone_info info{};
    std::ranges::copy(bone.name, info.name);
    std::ranges::copy(bone.inverse_bind, info.inverse_bind);
    return info;
}

plait_capsule capsule_of(const FittedCone& cone) {
    plait_capsule capsule{};
    std::ranges::copy(cone.a, capsule.a);
    std::ranges::copy(cone.b, capsule.b);
    capsule.radius_a = cone.radius_a;
    capsule.radius_b = cone.radius_b;
    return capsule;
}

Result<std::span<const std::byte>> field_bytes(const Mesh& mesh, plait_mesh_field field) {
    switch (field) {
    case PLAIT_MESH_FIELD_POSITIONS:
        return std::as_bytes(std::span(mesh.surface.positions));
    case PLAIT_MESH_FIELD_TRIANGLES:
        return std::as_bytes(std::span(mesh.surface.triangles));
    case PLAIT_MESH_FIELD_SOURCES:
        return std::as_bytes(std::span(mesh.sources));
    case PLAIT_MESH_FIELD_BONE_INDICES:
        return std::as_bytes(std::span(mesh.skin.indices));
    case PLAIT_MESH_FIELD_BONE_WEIGHTS:
        return std::as_bytes(std::span(mesh.skin.weights));
    default:
        return invalid(
            format("field is %d, range is [0, %d]", field, PLAIT_MESH_FIELD_BONE_WEIGHTS));
    }
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_mesh_desc_init(plait_mesh_desc* desc, size_t size) {
    api::init_struct(desc, size, plait_mesh_desc{});
}

void plait_mesh_info_init(plait_mesh_info* info, size_t size) {
    api::init_struct(info, size, plait_mesh_info{});
}

plait_result plait_mesh_create(const plait_mesh_desc* desc, const plait_import_options* options,
                               plait_mesh** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(out, "out"));
        plait_mesh_desc given{};
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        plait_import_options rules;
        PLAIT_TRY(api::read_options(options, rules));
        return api::make_mesh(rules, "", out, [&](Memory* memory) {
            return api::copy_mesh(given, rules.scale, memory);
        });
    });
}

plait_result plait_mesh_load(const char* path, const plait_import_options* options,
                             plait_mesh** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(path, "path"));
        PLAIT_TRY(api::need(out, "out"));
        plait_import_options rules;
        PLAIT_TRY(api::read_options(options, rules));
        return api::make_mesh(rules, std::string(path) + ": ", out, [&](Memory* memory) {
            return read_mesh(path, {rules.scale, memory});
        });
    });
}

plait_result plait_mesh_describe(const plait_mesh* mesh, plait_mesh_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::check_output(out, "out"));
        api::write_struct(out, api::describe(mesh->mesh));
        return {};
    });
}

plait_result plait_mesh_read(const plait_mesh* mesh, plait_mesh_field field, void* dst,
                             size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(mesh, "mesh"));
        const auto bytes = api::field_bytes(mesh->mesh, field);
        if (!bytes)
            return bytes.error();
        const auto wanted = api::wants_bytes(dst, size, bytes->size());
        if (!wanted)
            return wanted.error();
        if (*wanted && !bytes->empty())
            std::memcpy(dst, bytes->data(), bytes->size());
        return {};
    });
}

void plait_mesh_bone_info_init(plait_mesh_bone_info* info, size_t size) {
    api::init_struct(info, size, api::bone_info({}));
}

plait_result plait_mesh_read_bone(const plait_mesh* mesh, uint32_t index,
                                  plait_mesh_bone_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::check_output(out, "out"));
        const auto& bones = mesh->mesh.skin.bones;
        if (index >= bones.size())
            return Error{PLAIT_NOT_FOUND,
                         format("index is %u, the mesh has %zu bones", index, bones.size())};
        api::write_struct(out, api::bone_info(bones[index]));
        return {};
    });
}

plait_result plait_mesh_pose(const plait_mesh* mesh, const plait_view* bones, float* positions) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::need(bones, "bones"));
        PLAIT_TRY(api::need(positions, "positions"));
        const Mesh& at_rest = mesh->mesh;
        if (at_rest.skin.empty())
            return Error{PLAIT_INVALID_STATE, "the mesh has no skin"};
        Memory memory(mesh->own.allocator());
        std::pmr::vector<BoneMatrix> matrices(&memory);
        PLAIT_TRY(api::copy_rows(*bones, "bones", matrices));
        return pose_mesh(at_rest.surface.positions, at_rest.skin, matrices, positions);
    });
}

void plait_mesh_fit_info_init(plait_mesh_fit_info* info, size_t size) {
    api::init_struct(info, size, plait_mesh_fit_info{});
}

plait_result plait_mesh_fit(const plait_mesh* mesh, plait_capsule* dst, size_t count,
                            plait_mesh_fit_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(mesh, "mesh"));
        PLAIT_TRY(api::need(dst, "dst"));
        if (count < 1 || count > PLAIT_MESH_FIT_MAX)
            return api::invalid(
                format("count is %zu, range is [1, %d]", count, PLAIT_MESH_FIT_MAX));
        if (out)
            PLAIT_TRY(api::check_output(out, "out"));
        std::array<FittedCone, PLAIT_MESH_FIT_MAX> cones;
        const FitError error = fit_cones(mesh->mesh, std::span(cones).first(count));
        std::transform(cones.begin(), cones.begin() + static_cast<std::ptrdiff_t>(count), dst,
                       api::capsule_of);
        if (out)
            api::write_struct(out, {0, error.rms, error.percentile_99, error.greatest});
        return {};
    });
}

void plait_mesh_destroy(plait_mesh* mesh) {
    api::destroy(mesh);
}
}
