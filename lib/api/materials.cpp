// Materials and settings of a sim's strands.
#include "api/materials.hpp"

#include "api/structs.hpp"
#include "api/view.hpp"
#include "api/with_sim.hpp"
#include "core/params/params.hpp"

#include <plait/plait_offline.h>

namespace plait::api {

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

namespace {

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

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

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
}
