// Reading without waiting.
#include "api/with_sim.hpp"

#include <plait/plait_async.h>

using namespace plait;

extern "C" {

plait_result plait_sim_read_later(plait_sim* sim, plait_field field, void* dst, size_t size,
                                  uint64_t* fence) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        PLAIT_TRY(api::need(dst, "dst"));
        PLAIT_TRY(api::need(fence, "fence"));
        const auto bytes = s.field_bytes(field);
        if (!bytes)
            return bytes.error();
        if (size != *bytes)
            return api::invalid(format("size is %zu, the field has %zu bytes", size, *bytes));
        const auto made = s.read_later(field, dst);
        if (!made)
            return made.error();
        *fence = *made;
        return {};
    });
}

plait_result plait_sim_fence(plait_sim* sim, uint64_t* fence) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        PLAIT_TRY(api::need(fence, "fence"));
        const auto made = s.fence();
        if (!made)
            return made.error();
        *fence = *made;
        return {};
    });
}

plait_result plait_sim_fence_reached(plait_sim* sim, uint64_t fence, uint32_t* reached) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        PLAIT_TRY(api::need(reached, "reached"));
        const auto is = s.fence_reached(fence, false);
        if (!is)
            return is.error();
        *reached = *is ? 1 : 0;
        return {};
    });
}

plait_result plait_sim_fence_wait(plait_sim* sim, uint64_t fence) {
    return api::with_sim(__func__, sim, [&](Sim& s) -> Status {
        const auto reached = s.fence_reached(fence, true);
        return reached ? Status{} : Status(reached.error());
    });
}
}
