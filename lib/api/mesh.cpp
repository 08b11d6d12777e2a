// Meshes.
#include "core/mesh.hpp"
#include "core/mesh_fit.hpp"

#include "api/objects.hpp"
#include "api/options.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "io/io.hpp"

namespace plait::api {
namespace {

template <typename T> std::span<T> flat(std::pmr::vector<std::array<T, 3>>& rows) {
    return {rows.empty() ? nullptr : rows.front().data(), 3 * rows.size()};
}

template <typename T>
Status copy_rows(const plait_view& view, const char* name, std::pmr::vector<std::array<T, 3>>& to) {
    std::pmr::vector<T> values(to.get_allocator().resource());
    PLAIT_TRY(copy_view(view, 3, name, values));
    to.resize(view.count);
    std::ranges::copy(values, flat(to).begin());
    return {};
}

Result<TriangleSet> copy_surface(const plait_mesh_desc& desc, float scale, Memory* memory) {
    TriangleSet surface(memory);
    PLAIT_TRY(copy_rows(desc.positions, "desc->positions", surface.positions));
    PLAIT_TRY(copy_rows(desc.triangles, "desc->triangles", surface.triangles));
    for (float& coordinate : flat(surface.positions))
        coordinate *= scale;
    return surface;
}

// Mends what `read` (a callable: memory -> Result<TriangleSet>) gives and makes the handle.
template <typename Read>
Status make_mesh(const plait_import_options& options, const std::string& where, plait_mesh** out,
                 const Read& read) {
    Memory memory(options.allocator);
    auto handle = make_in<plait_mesh>(&memory, options.allocator);
    const auto raw = read(&memory);
    if (!raw)
        return raw.error();
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
    return info;
}

plait_collider_desc capsule_of(const FittedCone& cone) {
    plait_collider_desc capsule{};
    plait_collider_desc_init(&capsule, sizeof capsule);
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
    default:
        return invalid(format("field is %d, range is [0, %d]", field, PLAIT_MESH_FIELD_SOURCES));
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
            return api::copy_surface(given, rules.scale, memory);
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
        if (*wanted)
            std::memcpy(dst, bytes->data(), bytes->size());
        return {};
    });
}

void plait_mesh_fit_info_init(plait_mesh_fit_info* info, size_t size) {
    api::init_struct(info, size, plait_mesh_fit_info{});
}

plait_result plait_mesh_fit(const plait_mesh* mesh, plait_collider_desc* dst, size_t count,
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
        PLAIT_TRY(api::write_structs(dst, count, "dst",
                                     [&](size_t i) { return api::capsule_of(cones[i]); }));
        if (out)
            api::write_struct(out, {0, error.rms, error.percentile_99, error.greatest});
        return {};
    });
}

void plait_mesh_destroy(plait_mesh* mesh) {
    api::destroy(mesh);
}
}
