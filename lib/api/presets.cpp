// Kinds of hair by name.
#include "core/params/presets.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/with_sim.hpp"

#include <plait/plait_presets.h>

#include <algorithm>
#include <utility>

namespace plait::api {
namespace {

Status wet(Sim& sim) {
    const std::pmr::vector<float> all(sim.guides(), 1.0f, &sim.context().memory);
    return sim.write(PLAIT_FIELD_WETNESS, all.data());
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

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
        const auto next = with_preset({before, s.materials().table.front()}, **preset);
        if (!next)
            return next.error();
        const std::pmr::polymorphic_allocator<StrandMaterials> in_memory(&s.context().memory);
        auto materials = std::allocate_shared<StrandMaterials>(in_memory, s.materials());
        materials->table.front() = next->material;
        PLAIT_TRY(s.set_params(next->params));
        Status done = s.set_materials(std::move(materials));
        if (!done)
            (void)s.set_params(before); // as it was, but for what could not be got back
        else if (next->params.wetness.on)
            done = api::wet(s);
        return done;
    });
}
}
