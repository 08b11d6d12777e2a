// Many sims in one call.
#include "core/sim/together.hpp"

#include "api/objects.hpp"
#include "api/structs.hpp"
#include "api/wall.hpp"
#include "core/base/ranges.hpp"
#include "core/levels/sim_levels.hpp"

#include <plait/plait_levels.h>

#include <limits>

namespace plait::api {
namespace {

// What is in the list twice is known by the number that the list has: no memory is needed.
template <typename SimAt, typename NameOf>
Status check_sims(plait_context& context, size_t count, const SimAt& sim_at,
                  const NameOf& name_of) {
    const uint64_t list = ++context.lists;
    for (size_t i = 0; i < count; ++i) {
        plait_sim* const sim = sim_at(i);
        if (!sim)
            return invalid(name_of(i) + " is NULL");
        if (&sim->owner != &context)
            return invalid(name_of(i) + " is of another context");
        if (sim->list == list)
            return invalid(name_of(i) + " is " + name_of(sim->place) + " again");
        sim->list = list;
        sim->place = i;
    }
    return {};
}

plait_character default_character() {
    plait_character character{};
    character.struct_size = sizeof character;
    character.importance = 1;
    character.width = 6.5f;
    return character;
}

plait_director_desc default_director() {
    plait_director_desc desc{};
    desc.struct_size = sizeof desc;
    desc.tolerance_px = 2;
    desc.hair_px = 1;
    desc.hold_s = 0.5f;
    desc.rest_px = 3;
    return desc;
}

Status check_director(const plait_director_desc& s) {
    PLAIT_RANGE(budget_ms, 0, 1e4);
    PLAIT_RANGE(tolerance_px, 0.05f, 100);
    PLAIT_RANGE(hair_px, 0.25, 8);
    PLAIT_RANGE(last_ms, 0, 1e4);
    PLAIT_RANGE(hold_s, 0, 60);
    PLAIT_RANGE(rest_px, 0, 100);
    return {};
}

Status check_characters(std::span<const plait_character> characters) {
    for (size_t i = 0; i < characters.size(); ++i) {
        const auto check = [&](const char* field, float value, double high) {
            return check_range(format("characters[%zu].%s", i, field).c_str(), double(value), 0,
                               high);
        };
        PLAIT_TRY(check("pixels_per_metre", characters[i].pixels_per_metre, 1e6));
        PLAIT_TRY(check("importance", characters[i].importance, 1e3));
        PLAIT_TRY(check("width", characters[i].width, 1e3));
    }
    return {};
}

// m/s at which hair is taken to be still.
float rest_of(const plait_character& character, const plait_director_desc& desc) {
    constexpr float most = 0.05f;
    if (desc.rest_px == 0)
        return 0;
    return std::min(most,
                    desc.rest_px / character.pixels_per_metre); // infinite where it is not seen
}

// Adds a character to those who are directed, where its sim has levels; false: it has none. Hair that sleeps
// costs nothing and is not wrong, as long as what is shown of it is enough.
bool add_hair(const plait_character& character, const DirectorGoal& goal, float rest, double dt,
              std::pmr::vector<DirectedHair>& to) {
    plait_sim& sim = *character.sim;
    DirectedHair hair;
    if (!sim.sim.describe_levels(hair))
        return false;
    const bool seen = character.pixels_per_metre > 0;
    sim.unseen = seen ? 0 : sim.unseen + dt;
    sim.chosen_since += dt;
    hair.pixels_per_metre = double(character.pixels_per_metre);
    hair.importance = double(character.importance);
    hair.width = double(character.width);
    hair.since = sim.chosen_since;
    hair.unseen = sim.unseen;
    sim.sim.set_rest(rest);
    if (!seen) // it may take any choice the moment it is seen
        sim.chosen_since = std::numeric_limits<double>::infinity();
    if (!sim.sim.is_asleep() || !covers(hair, goal))
        to.push_back(hair);
    return true;
}

Status direct(plait_context& context, std::span<const plait_character> characters,
              const plait_director_desc& desc, double dt, plait_director_info& info) {
    std::pmr::vector<DirectedHair> hair(&context.memory());
    std::pmr::vector<const plait_character*> directed(&context.memory());
    const DirectorGoal goal{double(desc.budget_ms), double(desc.tolerance_px), double(desc.hair_px),
                            double(desc.hold_s)};
    info.passed_over = 0;
    for (const plait_character& character : characters) {
        const size_t before = hair.size();
        info.passed_over += !add_hair(character, goal, rest_of(character, desc), dt, hair);
        if (hair.size() > before)
            directed.push_back(&character);
    }
    std::pmr::vector<LevelChoice> choices(hair.size(), &context.memory());
    Director& director = context.context.director;
    director.took(double(desc.last_ms), dt);
    const DirectorReport report = director.choose(hair, goal, choices);
    for (size_t i = 0; i < hair.size(); ++i) {
        if (choices[i] == hair[i].now)
            continue;
        plait_level_choice choice = default_level_choice();
        choice.level = choices[i].level;
        choice.shown = choices[i].shown;
        choice.rest = rest_of(*directed[i], desc);
        PLAIT_TRY(directed[i]->sim->sim.set_level(choice));
        directed[i]->sim->chosen_since = 0;
    }
    info.changed = report.changed;
    info.predicted_ms = static_cast<float>(report.predicted);
    info.worst_px = static_cast<float>(report.worst);
    return {};
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" {

plait_result plait_context_step(plait_context* context, plait_sim* const* sims, size_t count,
                                double dt) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        if (count > 0)
            PLAIT_TRY(api::need(sims, "sims"));
        const auto time = api::checked_dt(dt);
        if (!time)
            return time.error();
        PLAIT_TRY(api::check_sims(
            *context, count, [&](size_t i) { return sims[i]; },
            [](size_t i) { return format("sims[%zu]", i); }));
        return step_together(
            context->context, count, [&](size_t i) -> Sim& { return sims[i]->sim; }, *time);
    });
}

void plait_character_init(plait_character* character, size_t size) {
    api::init_struct(character, size, api::default_character());
}

void plait_director_desc_init(plait_director_desc* desc, size_t size) {
    api::init_struct(desc, size, api::default_director());
}

void plait_director_info_init(plait_director_info* info, size_t size) {
    api::init_struct(info, size, plait_director_info{});
}

plait_result plait_context_direct(plait_context* context, const plait_character* characters,
                                  size_t count, const plait_director_desc* desc, double dt,
                                  plait_director_info* info) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        plait_director_desc given = api::default_director();
        if (desc)
            PLAIT_TRY(api::read_struct(desc, given, "desc"));
        PLAIT_TRY(api::check_director(given));
        if (info)
            PLAIT_TRY(api::check_output(info, "info"));
        const auto time = api::checked_dt(dt);
        if (!time)
            return time.error();
        std::pmr::vector<plait_character> list(&context->memory());
        PLAIT_TRY(
            api::read_structs(characters, count, "characters", api::default_character(), list));
        PLAIT_TRY(api::check_sims(
            *context, count, [&](size_t i) { return list[i].sim; },
            [](size_t i) { return format("characters[%zu].sim", i); }));
        PLAIT_TRY(api::check_characters(list));
        plait_director_info made{};
        PLAIT_TRY(api::direct(*context, list, given, *time, made));
        if (info)
            api::write_struct(info, made);
        return {};
    });
}

} // extern "C"
