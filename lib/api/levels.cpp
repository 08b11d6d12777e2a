// Levels of detail of a groom.
#include "core/levels/levels.hpp"

#include "api/hair_frame.hpp"
#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/view.hpp"
#include "api/with_sim.hpp"

namespace plait::api {
namespace {

Status check_level_count(const plait_levels_desc& desc) {
    if (desc.level_count <= PLAIT_LEVELS_MAX)
        return {};
    return invalid(
        format("desc->level_count is %u, range is [0, %d]", desc.level_count, PLAIT_LEVELS_MAX));
}

Status hang(const plait_levels_desc& desc, plait_levels& to) {
    if (desc.hung.count == 0)
        return {};
    const plait_roots as_groomed = default_roots();
    RootsCopy copy(&to.own);
    HairFrame frame;
    PLAIT_TRY(read_hair(desc.roots ? desc.roots : &as_groomed, desc.hung, to.levels.strands(),
                        to.levels.longest(), copy, frame, "desc->hung"));
    return to.levels.hang(copy.input(), frame);
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

void plait_levels_desc_init(plait_levels_desc* desc, size_t size) {
    api::init_struct(desc, size, plait_levels_desc{});
}

void plait_level_init(plait_level* level, size_t size) {
    api::init_struct(level, size, plait_level{});
}

plait_result plait_levels_create(const plait_levels_desc* desc, plait_levels** out) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(out, "out"));
        plait_levels_desc given{};
        PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(api::need(given.groom, "desc->groom"));
        PLAIT_TRY(api::check_level_count(given));
        const plait_allocator allocator = given.groom->own.allocator();
        Memory memory(allocator);
        auto handle = make_in<plait_levels>(&memory, allocator);
        PLAIT_TRY(handle->levels.create(given.groom->groom, {given.guides, given.level_count},
                                        given.seed));
        PLAIT_TRY(api::hang(given, *handle));
        *out = handle.release();
        return {};
    });
}

plait_result plait_levels_list(const plait_levels* levels, plait_level* dst, size_t* count) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(levels, "levels"));
        const auto guides = levels->levels.guides();
        return api::write_list(dst, count, guides.size(), [&](size_t i) -> plait_level {
            return {sizeof(plait_level), guides[i], static_cast<float>(levels->levels.share(i))};
        });
    });
}

plait_result plait_levels_take(const plait_levels* levels, size_t level, plait_groom** guides,
                               plait_follow_map** map) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(levels, "levels"));
        PLAIT_TRY(api::need(guides, "guides"));
        PLAIT_TRY(api::need(map, "map"));
        const size_t count = levels->levels.guides().size();
        if (level >= count)
            return api::invalid(format("level is %zu, range is [0, %zu]", level, count - 1));
        const plait_allocator allocator = levels->own.allocator();
        Memory memory(allocator);
        auto chosen = make_in<plait_groom>(&memory, allocator);
        auto follows = make_in<plait_follow_map>(&memory, allocator);
        PLAIT_TRY(levels->levels.take(level, chosen->groom, follows->map));
        *guides = chosen.release();
        *map = follows.release();
        return {};
    });
}

void plait_level_choice_init(plait_level_choice* choice, size_t size) {
    api::init_struct(choice, size, default_level_choice());
}

void plait_level_state_init(plait_level_state* state, size_t size) {
    api::init_struct(state, size, plait_level_state{});
}

plait_result plait_sim_set_level(plait_sim* sim, const plait_level_choice* choice) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        plait_level_choice given = default_level_choice();
        PLAIT_TRY(api::read_struct(choice, given, "choice"));
        return s.set_level(given);
    });
}

plait_result plait_sim_get_level(plait_sim* sim, plait_level_state* state) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        PLAIT_TRY(api::check_output(state, "state"));
        const auto found = s.level_state();
        if (!found)
            return found.error();
        api::write_struct(state, *found);
        return {};
    });
}

void plait_levels_destroy(plait_levels* levels) {
    api::destroy(levels);
}
}
