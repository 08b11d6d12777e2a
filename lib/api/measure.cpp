// Simulation: reading, writing and measuring.
#include "api/objects.hpp"
#include "api/structs.hpp"

#include <plait/plait_profile.h>

#include <string_view>

using namespace plait;

namespace {

plait_launch launch_of(const plait_stage_launch& launch) {
    plait_launch out{};
    const std::string_view name = plait_stage_describe(launch.stage)->name;
    name.copy(out.stage, sizeof out.stage - 1);
    out.items = launch.item_count;
    out.bytes = launch.bytes;
    out.queued_ns = launch.queued_ns;
    out.begin_ns = launch.begin_ns;
    out.end_ns = launch.end_ns;
    return out;
}

} // namespace

extern "C" {

plait_result plait_sim_read(plait_sim* sim, plait_field field, void* dst, size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        const auto bytes = sim->sim.field_bytes(field);
        if (!bytes)
            return bytes.error();
        const auto wanted = api::wants_bytes(dst, size, *bytes);
        if (!wanted)
            return wanted.error();
        return *wanted ? sim->sim.read(field, dst) : Status{};
    });
}

plait_result plait_sim_write(plait_sim* sim, plait_field field, const void* src, size_t size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(src, "src"));
        if (field != PLAIT_FIELD_POSITION && field != PLAIT_FIELD_POSITION_PREV &&
            field != PLAIT_FIELD_VELOCITY && field != PLAIT_FIELD_ACCELERATION &&
            field != PLAIT_FIELD_PIN && field != PLAIT_FIELD_WETNESS)
            return api::invalid(format("field is %d, only POSITION, POSITION_PREV, VELOCITY, "
                                       "ACCELERATION, PIN and WETNESS can be written",
                                       field));
        const auto needed =
            sim->sim.field_bytes(field == PLAIT_FIELD_WETNESS ? field : PLAIT_FIELD_POSITION_PREV);
        if (!needed)
            return needed.error();
        if (size != *needed)
            return api::invalid(format("size is %zu bytes, the guides take %zu", size, *needed));
        return sim->sim.write(field, src);
    });
}

plait_result plait_sim_save(plait_sim* sim, void* dst, size_t* size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        const auto wanted = api::wants_bytes(dst, size, sim->sim.snapshot_size());
        if (!wanted)
            return wanted.error();
        return *wanted ? sim->sim.save({static_cast<unsigned char*>(dst), *size}) : Status{};
    });
}

plait_result plait_sim_restore(plait_sim* sim, const void* src, size_t size) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(src, "src"));
        return sim->sim.restore({static_cast<const unsigned char*>(src), size});
    });
}

plait_result plait_sim_hash(plait_sim* sim, uint64_t* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(out, "out"));
        const auto hash = sim->sim.hash();
        if (!hash)
            return hash.error();
        *out = *hash;
        return {};
    });
}

void plait_sim_measures_init(plait_sim_measures* measures, size_t size) {
    api::init_struct(measures, size, plait_sim_measures{});
}

plait_result plait_sim_measure(plait_sim* sim, plait_sim_measures* out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::check_output(out, "out"));
        plait_sim_measures measures;
        PLAIT_TRY(sim->sim.measure(measures));
        api::write_struct(out, measures);
        return {};
    });
}

plait_result plait_sim_get_stage_times(plait_sim* sim, plait_stage_time* dst, size_t* count,
                                       uint32_t reset) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(count, "count"));
        const size_t available = sim->sim.stage_time_count();
        if (!dst) {
            *count = available;
            return {};
        }
        const size_t number = std::min(*count, available);
        PLAIT_TRY(sim->sim.stage_times({dst, number}, reset != 0));
        *count = number;
        return {};
    });
}

void plait_launch_init(plait_launch* launch, size_t size) {
    api::init_struct(launch, size, plait_launch{});
}

plait_result plait_sim_take_launches(plait_sim* sim, plait_launch* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(sim, "sim"));
        PLAIT_TRY(api::need(count, "count"));
        const auto kept = sim->sim.launch_count();
        PLAIT_TRY(kept);
        const size_t number = dst ? std::min(*count, *kept) : *kept;
        if (dst) {
            PLAIT_TRY(api::write_structs(dst, number, "dst",
                                         [&](size_t i) { return launch_of(sim->sim.launch(i)); }));
            sim->sim.forget_launches(number);
        }
        *count = number;
        return {};
    });
}
}
