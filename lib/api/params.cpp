// Parameters by their names: the table of them, and single ones of a sim.
#include "core/params/param_by_name.hpp"
#include "core/params/param_table.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"

#include <algorithm>

using namespace plait;

extern "C" {

void plait_param_info_init(plait_param_info* info, size_t size) {
    api::init_struct(info, size, plait_param_info{});
}

plait_result plait_params_list(plait_param_info* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(count, "count"));
        const auto table = param_table();
        const size_t number = dst ? std::min(*count, table.size()) : table.size();
        if (dst)
            PLAIT_TRY(api::write_structs(dst, number, "dst", [&](size_t i) { return table[i]; }));
        *count = number;
        return {};
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
        const auto changed = with_param(sim->sim.params(), **param, {values, count});
        return changed ? sim->sim.set_params(*changed) : Status(changed.error());
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
            dst[i] = param_component(**param, sim->sim.params(), i);
        *count = number;
        return {};
    });
}
}
