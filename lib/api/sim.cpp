// Simulation: creating, steering and stepping.
#include "core/sim/sim.hpp"

#include "api/objects.hpp"
#include "api/roots.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "core/follows/detail.hpp"
#include "core/groom/materials.hpp"
#include "core/params/params.hpp"
#include "core/wind/wind.hpp"

#include <plait/plait_offline.h>

#include <algorithm>
#include <cmath>

namespace plait::api {
namespace {

// The parameters inside a descriptor cannot be longer than the room they have there.
Status read_desc(const plait_sim_desc* given, plait_sim_desc& desc) {
    desc = default_sim_desc();
    if (!given)
        return {};
    PLAIT_TRY(read_struct(given, desc, "desc"));
    const plait_sim_params inner = desc.params;
    if (inner.struct_size > sizeof inner)
        return invalid(format("desc->params.struct_size is %u, range is [4, %zu]",
                              inner.struct_size, sizeof inner));
    desc.params = default_sim_params();
    PLAIT_TRY(read_struct(&inner, desc.params, "desc->params"));
    return check_sim_desc(desc);
}

// The default one where nothing is given.
Result<StrandMaterialsPtr> read_materials(const plait_material* list, size_t count,
                                          const plait_view& strand_material, size_t guides,
                                          std::pmr::memory_resource* memory) {
    const std::pmr::polymorphic_allocator<StrandMaterials> in_memory(memory);
    const auto materials = std::allocate_shared<StrandMaterials>(
        in_memory, StrandMaterials{std::pmr::vector<plait_material>(memory),
                                   std::pmr::vector<uint32_t>(memory)});
    PLAIT_TRY(read_structs(list, count, "materials", default_material(), materials->table));
    PLAIT_TRY(copy_view(strand_material, 1, "strand_material", materials->of));
    if (count == 0 && !materials->of.empty())
        return invalid(format("strand_material.count is %zu, and there are no materials",
                              materials->of.size()));
    if (count == 0)
        materials->table.push_back(default_material());
    PLAIT_TRY(check_materials(*materials, guides));
    return StrandMaterialsPtr(materials);
}

// Of every guide strand.
Result<SettingsList> read_settings(const plait_strand_settings* list, size_t count,
                                   const plait_view& strand_settings, Sim& sim) {
    std::pmr::memory_resource* const memory = &sim.context().memory;
    if (count < 1 || count > PLAIT_STRAND_SETTINGS_MAX)
        return invalid(format("count is %zu, range is [1, %d]", count, PLAIT_STRAND_SETTINGS_MAX));
    std::pmr::vector<plait_strand_settings> table(memory);
    PLAIT_TRY(read_structs(list, count, "settings", default_strand_settings(), table));
    for (size_t i = 0; i < table.size(); ++i)
        if (const auto status = check_strand_settings(table[i]); !status)
            return invalid(format("settings[%zu]: %s", i, status.error().message.c_str()));
    std::pmr::vector<uint32_t> of(memory);
    PLAIT_TRY(copy_view(strand_settings, 1, "strand_settings", of));
    if (strand_settings.count == 0)
        of.assign(sim.guides(), 0);
    if (of.size() != sim.guides())
        return invalid(format("strand_settings.count is %zu, the sim has %zu guides", of.size(),
                              sim.guides()));
    SettingsList settings(memory);
    for (size_t i = 0; i < of.size(); ++i) {
        if (of[i] >= table.size())
            return invalid(format("strand_settings[%zu] is %u, range is [0, %zu], the settings", i,
                                  of[i], table.size() - 1));
        settings.push_back(make_settings(table[of[i]], sim.substeps()));
    }
    return settings;
}

// The common shape of the calls that take a sim and can fail.
template <typename Body>
plait_result with_sim(const char* function, plait_sim* sim, const Body& body) noexcept {
    return guard(function, [&]() -> Status {
        PLAIT_TRY(need(sim, "sim"));
        return body(sim->sim);
    });
}

// A feature that `desc` describes, or NULL that it is off; `feature` is where params have it.
template <typename Desc>
plait_result set_feature(const char* function, plait_sim* sim, const Desc* desc,
                         const Desc& defaults, Feature<Desc> Params::*feature) noexcept {
    return with_sim(function, sim, [&](Sim& s) -> Status {
        if (!desc && !(s.params().*feature).on)
            return {};
        Params next = s.params();
        next.*feature = {defaults, desc != nullptr};
        if (desc)
            PLAIT_TRY(read_struct(desc, static_cast<Desc&>(next.*feature), "desc"));
        PLAIT_TRY(check_params(next));
        return s.set_params(next);
    });
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_sim_params_init(plait_sim_params* params, size_t size) {
    api::init_struct(params, size, default_sim_params());
}

void plait_material_init(plait_material* material, size_t size) {
    api::init_struct(material, size, default_material());
}

void plait_fibre_init(plait_fibre* fibre, size_t size) {
    api::init_struct(fibre, size, default_fibre());
}

plait_result plait_material_set_fibre(plait_material* material, const plait_fibre* fibre) {
    return api::guard(__func__, [&]() -> Status {
        plait_material changed = default_material();
        PLAIT_TRY(api::read_struct(material, changed, "material"));
        plait_fibre given = default_fibre();
        PLAIT_TRY(api::read_struct(fibre, given, "fibre"));
        PLAIT_TRY(set_fibre(changed, given));
        api::write_struct(material, changed);
        return {};
    });
}

void plait_sim_desc_init(plait_sim_desc* desc, size_t size) {
    api::init_struct(desc, size, default_sim_desc());
}

void plait_roots_init(plait_roots* roots, size_t size) {
    api::init_struct(roots, size, api::default_roots());
}

plait_result plait_sim_create(plait_context* context, const plait_groom* groom,
                              const plait_sim_desc* desc, plait_sim** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        PLAIT_TRY(api::need(groom, "groom"));
        PLAIT_TRY(api::need(out, "out"));
        plait_sim_desc given;
        PLAIT_TRY(api::read_desc(desc, given));
        std::pmr::vector<float> stiffness(&context->context.memory);
        PLAIT_TRY(api::copy_view(given.strand_stiffness, 1, "desc->strand_stiffness", stiffness));
        PLAIT_TRY(check_strand_stiffness(stiffness, groom->groom.shape.strands));
        auto materials =
            api::read_materials(given.materials, given.material_count, given.strand_material,
                                groom->groom.shape.strands, &context->context.memory);
        if (!materials)
            return materials.error();
        const FollowMap* const follows = given.follow_map ? &given.follow_map->map : nullptr;
        given.strand_stiffness = given.strand_material = {}; // the caller's
        given.materials = nullptr;
        given.follow_map = nullptr;
        auto parts =
            make_sim_parts(context->context, groom->groom, given, {stiffness, *materials, follows});
        if (!parts)
            return parts.error();
        auto handle = make_in<plait_sim>(&context->context.memory, *context, std::move(*parts));
        PLAIT_TRY(handle->sim.start());
        *out = handle.release();
        return {};
    });
}

void plait_sim_destroy(plait_sim* sim) {
    plait_context* const owner = sim ? &sim->owner : nullptr;
    api::destroy(sim);
    api::destroy_unused(owner);
}

void plait_sim_info_init(plait_sim_info* info, size_t size) {
    plait_sim_info empty{};
    empty.worst_stiffening = empty.scale = 1;
    api::init_struct(info, size, empty);
}

plait_result plait_sim_describe(const plait_sim* sim, plait_sim_info* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(out, "out"));
        api::write_struct(out, sim->sim.describe());
        return {};
    });
}

plait_result plait_sim_reset(plait_sim* sim) {
    return api::with_sim(__func__, sim, [](Sim& s) { return s.reset(); });
}

plait_result plait_sim_set_pins(plait_sim* sim, const plait_pin* pins, size_t count) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (count > 0)
            PLAIT_TRY(api::need(pins, "pins"));
        return s.set_pins({pins, count});
    });
}

void plait_wind_desc_init(plait_wind_desc* desc, size_t size) {
    api::init_struct(desc, size, default_wind_desc());
}

plait_result plait_sim_set_wind(plait_sim* sim, const plait_wind_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_wind(nullptr);
        plait_wind_desc given = default_wind_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(check_wind(given));
        return s.set_wind(&given);
    });
}

void plait_frame_desc_init(plait_frame_desc* desc, size_t size) {
    api::init_struct(desc, size, default_frame_desc());
}

plait_result plait_sim_set_frame(plait_sim* sim, const plait_frame_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_frame(nullptr);
        plait_frame_desc given = default_frame_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        const auto checked = checked_frame(given);
        if (!checked)
            return checked.error();
        return s.set_frame(&*checked);
    });
}

void plait_detail_desc_init(plait_detail_desc* desc, size_t size) {
    api::init_struct(desc, size, default_detail_desc());
}

plait_result plait_sim_set_detail(plait_sim* sim, const plait_detail_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        if (!desc)
            return s.set_detail(nullptr, {});
        plait_detail_desc given = default_detail_desc();
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(check_detail(given));
        std::pmr::vector<uint32_t> centres(&s.context().memory);
        PLAIT_TRY(api::copy_view(given.clump_centres, 1, "desc->clump_centres", centres));
        return s.set_detail(&given, centres);
    });
}

plait_result plait_sim_set_params(plait_sim* sim, const plait_sim_params* params) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        Params next = s.params();
        plait_sim_params& given = next;
        given = default_sim_params();
        PLAIT_TRY(api::read_struct(params, given, "params"));
        PLAIT_TRY(check_params(next));
        return s.set_params(next);
    });
}

plait_result plait_sim_get_params(const plait_sim* sim, plait_sim_params* params) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(params, "params"));
        api::write_struct(params, static_cast<const plait_sim_params&>(sim->sim.params()));
        return {};
    });
}

void plait_tressfx_desc_init(plait_tressfx_desc* desc, size_t size) {
    api::init_struct(desc, size, default_tressfx_desc());
}

plait_result plait_sim_set_tressfx(plait_sim* sim, const plait_tressfx_desc* desc) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        Params next = s.params();
        next.tressfx = default_tressfx_desc();
        if (desc)
            PLAIT_TRY(api::read_struct(desc, next.tressfx, "desc"));
        PLAIT_TRY(check_params(next));
        PLAIT_TRY(check_reads_tressfx(s.model()));
        return s.set_params(next);
    });
}

void plait_grid_desc_init(plait_grid_desc* desc, size_t size) {
    api::init_struct(desc, size, default_grid_desc());
}

plait_result plait_sim_set_grid(plait_sim* sim, const plait_grid_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_grid_desc(), &Params::grid);
}

void plait_volume_desc_init(plait_volume_desc* desc, size_t size) {
    api::init_struct(desc, size, default_volume_desc());
}

plait_result plait_sim_set_volume(plait_sim* sim, const plait_volume_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_volume_desc(), &Params::volume);
}

void plait_strand_contact_desc_init(plait_strand_contact_desc* desc, size_t size) {
    api::init_struct(desc, size, default_strand_contact_desc());
}

plait_result plait_sim_set_strand_contact(plait_sim* sim, const plait_strand_contact_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_strand_contact_desc(),
                            &Params::strand_contact);
}

void plait_wetness_desc_init(plait_wetness_desc* desc, size_t size) {
    api::init_struct(desc, size, default_wetness_desc());
}

plait_result plait_sim_set_wetness(plait_sim* sim, const plait_wetness_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_wetness_desc(), &Params::wetness);
}

void plait_acceleration_desc_init(plait_acceleration_desc* desc, size_t size) {
    api::init_struct(desc, size, default_acceleration_desc());
}

plait_result plait_sim_set_acceleration(plait_sim* sim, const plait_acceleration_desc* desc) {
    return api::set_feature(__func__, sim, desc, default_acceleration_desc(),
                            &Params::acceleration);
}

plait_result plait_sim_set_materials(plait_sim* sim, const plait_material* materials, size_t count,
                                     plait_view strand_material) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        auto read =
            api::read_materials(materials, count, strand_material, s.guides(), &s.context().memory);
        if (!read)
            return read.error();
        return s.set_materials(*read);
    });
}

plait_result plait_sim_find_balance(plait_sim* sim) {
    return api::with_sim(__func__, sim, [](Sim& s) { return s.find_balance(); });
}

void plait_strand_settings_init(plait_strand_settings* settings, size_t size) {
    api::init_struct(settings, size, default_strand_settings());
}

plait_result plait_sim_set_settings(plait_sim* sim, const plait_strand_settings* settings,
                                    size_t count, plait_view strand_settings) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const auto list = api::read_settings(settings, count, strand_settings, s);
        if (!list)
            return list.error();
        return s.set_settings(*list);
    });
}

plait_result plait_sim_get_settings(const plait_sim* sim, plait_strand_settings* dst,
                                    size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(count, "count"));
        const auto settings = sim->sim.settings();
        if (dst && *count < settings.size())
            return api::invalid(
                format("*count is %zu, the sim has %zu guides", *count, settings.size()));
        if (dst)
            PLAIT_TRY(api::write_structs(dst, settings.size(), "dst", [&](size_t i) {
                const Settings& of = settings[i];
                return plait_strand_settings{sizeof(plait_strand_settings), of.substeps,
                                             of.iterations, of.bdf2};
            }));
        *count = settings.size();
        return {};
    });
}

plait_result plait_sim_bind_roots(plait_sim* sim, const plait_mesh* mesh, plait_root_place* dst,
                                  size_t count) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const size_t guides = s.guides();
        if (mesh && dst && count < guides)
            return api::invalid(format("count is %zu, the sim has %zu guides", count, guides));
        return s.bind_roots(mesh ? &mesh->mesh : nullptr, {dst, mesh && dst ? guides : 0});
    });
}

plait_result plait_sim_set_roots(plait_sim* sim, const plait_roots* roots) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        api::RootsCopy copy(&s.context().memory);
        PLAIT_TRY(api::read_roots(roots, copy));
        return s.set_roots(copy.input());
    });
}

plait_result plait_sim_teleport(plait_sim* sim, const plait_roots* roots) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        api::RootsCopy copy(&s.context().memory);
        PLAIT_TRY(api::read_roots(roots, copy));
        return s.teleport(copy.input());
    });
}

plait_result plait_sim_step(plait_sim* sim, double dt) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const auto time = api::checked_dt(dt);
        return time ? s.step(*time) : Status(time.error());
    });
}

plait_result plait_sim_wait(plait_sim* sim) {
    return api::with_sim(__func__, sim, [](Sim& s) { return s.wait(); });
}
}
