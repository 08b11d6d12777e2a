// Parameters by their names: the table of them, single ones of a sim, and kinds of hair, which are lists of them.
#include "core/params/param_by_name.hpp"
#include "core/params/param_table.hpp"
#include "core/params/presets.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/with_sim.hpp"

#include <plait/plait_presets.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace plait::api {
namespace {

NamedParams named(const Sim& sim) {
    return {sim.params(), sim.materials().table.front()};
}

bool is_of_material(const plait_param_info& param) {
    return std::string_view(param.feature) == "material";
}

// In place of the only one.
Status set_material(Sim& sim, const plait_material& material) {
    const std::pmr::polymorphic_allocator<StrandMaterials> in_memory(&sim.context().memory);
    auto materials = std::allocate_shared<StrandMaterials>(in_memory, sim.materials());
    materials->table.front() = material;
    return sim.set_materials(std::move(materials));
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_param_info_init(plait_param_info* info, size_t size) {
    api::init_struct(info, size, plait_param_info{});
}

plait_result plait_params_list(plait_param_info* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        const auto table = param_table();
        return api::write_list(dst, count, table.size(), [&](size_t i) { return table[i]; });
    });
}

plait_result plait_sim_set_param(plait_sim* sim, const char* name, const double* values,
                                 size_t count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(name, "name"));
        const auto param = find_param(name);
        if (!param)
            return param.error();
        if (count > 0)
            PLAIT_TRY(api::need(values, "values"));
        const bool of_material = api::is_of_material(**param);
        if (const size_t materials = sim->sim.materials().table.size();
            of_material && materials > 1)
            return Error{PLAIT_INVALID_STATE,
                         format("strands are of %zu materials, and %s is one's: "
                                "plait_sim_set_materials sets them",
                                materials, name)};
        const auto changed = with_param(api::named(sim->sim), **param, {values, count});
        if (!changed)
            return changed.error();
        return of_material ? api::set_material(sim->sim, changed->material)
                           : sim->sim.set_params(changed->params);
    });
}

plait_result plait_sim_get_param(const plait_sim* sim, const char* name, double* dst,
                                 size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(name, "name"));
        PLAIT_TRY(api::need(count, "count"));
        const auto param = find_param(name);
        if (!param)
            return param.error();
        const size_t components = (*param)->count;
        const size_t number = dst ? std::min(*count, components) : components;
        for (uint32_t i = 0; dst && i < number; ++i)
            dst[i] = param_component(**param, api::named(sim->sim), i);
        *count = number;
        return {};
    });
}

void plait_preset_info_init(plait_preset_info* info, size_t size) {
    api::init_struct(info, size, plait_preset_info{});
}

void plait_preset_value_init(plait_preset_value* value, size_t size) {
    api::init_struct(value, size, plait_preset_value{});
}

plait_result plait_presets_list(plait_preset_info* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        return api::write_list(dst, count, presets().size(), [](size_t i) {
            const Preset& preset = presets()[i];
            return plait_preset_info{sizeof(plait_preset_info), preset.name, preset.text,
                                     preset.groom};
        });
    });
}

plait_result plait_preset_read(const char* name, plait_preset_value* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(name, "name"));
        const auto preset = find_preset(name);
        if (!preset)
            return preset.error();
        return api::write_list(dst, count, (*preset)->values.size(), [&](size_t i) {
            const PresetValue& value = (*preset)->values[i];
            plait_preset_value row{sizeof(plait_preset_value), value.param, {}, value.count};
            std::ranges::copy(value.values, row.values);
            return row;
        });
    });
}

plait_result plait_sim_set_preset(plait_sim* sim, const char* name) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        PLAIT_TRY(api::need(name, "name"));
        const auto preset = find_preset(name);
        if (!preset)
            return preset.error();
        if (s.model() == PLAIT_MODEL_TRESSFX)
            return Error{PLAIT_INVALID_STATE, "presets are for the model articulated"};
        if (const size_t materials = s.materials().table.size(); materials > 1)
            return Error{PLAIT_INVALID_STATE,
                         format("strands are of %zu materials, and a preset has one: "
                                "plait_preset_read has its values",
                                materials)};
        const Params before = s.params();
        const auto next = with_preset(api::named(s), **preset);
        if (!next)
            return next.error();
        const std::pmr::vector<float> wet(next->params.wetness.on ? s.guides() : 0, 1.0f,
                                          &s.context().memory);
        PLAIT_TRY(s.set_params(next->params));
        if (const Status status = api::set_material(s, next->material); !status) {
            (void)s.set_params(before);
            return status;
        }
        return next->params.wetness.on ? s.write(PLAIT_FIELD_WETNESS, wet.data()) : Status{};
    });
}
}
