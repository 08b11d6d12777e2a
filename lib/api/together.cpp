// Many sims in one call.
#include "core/sim/together.hpp"

#include "api/objects.hpp"
#include "api/wall.hpp"

namespace plait::api {
namespace {

// What is in the list twice is known by the number that the list has: no memory is needed.
Status check_sims(plait_context& context, plait_sim* const* sims, size_t count) {
    const uint64_t list = ++context.lists;
    for (size_t i = 0; i < count; ++i) {
        if (!sims[i])
            return invalid(format("sims[%zu] is NULL", i));
        if (&sims[i]->owner != &context)
            return invalid(format("sims[%zu] is of another context", i));
        if (sims[i]->list == list)
            return invalid(format("sims[%zu] is sims[%zu] again", i, sims[i]->place));
        sims[i]->list = list;
        sims[i]->place = i;
    }
    return {};
}

} // namespace
} // namespace plait::api

using namespace plait;

extern "C" plait_result plait_context_step(plait_context* context, plait_sim* const* sims,
                                           size_t count, double dt) {
    return api::guard(__func__, [&]() -> Status {
        PLAIT_TRY(api::need(context, "context"));
        if (count > 0)
            PLAIT_TRY(api::need(sims, "sims"));
        const auto time = api::checked_dt(dt);
        if (!time)
            return time.error();
        PLAIT_TRY(api::check_sims(*context, sims, count));
        return step_together(
            context->context, count, [&](size_t i) -> Sim& { return sims[i]->sim; }, *time);
    });
}
