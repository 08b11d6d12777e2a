// What the opaque handles of plait.h point to. Each begins with the memory it lives in.
#pragma once

#include "base/memory.hpp"
#include "core/sim.hpp"

struct plait_context {
    plait::Context context;

    plait_context(const plait::ContextRules& rules, plait::Device opened,
                  const plait_device_info& described)
        : context(rules, std::move(opened), described) {}
    plait::Memory& memory() { return context.memory; }
};

struct plait_groom {
    plait::Memory own;
    plait::Groom groom;

    explicit plait_groom(const plait_allocator& allocator)
        : own(allocator), groom{plait::StrandSet(&own), {}, {}} {}
    plait::Memory& memory() { return own; }
};

struct plait_sim {
    plait::Sim sim;

    plait_sim(plait::Context& context, plait::SimParts parts) : sim(context, std::move(parts)) {}
    plait::Memory& memory() { return sim.context().memory; }
};

namespace plait::api {

// Deletes a handle whose memory resource may be inside it.
template <typename Handle> void destroy(Handle* handle) {
    if (!handle)
        return;
    Memory memory(handle->memory().allocator());
    DeleteIn<Handle>{&memory}(handle);
}

} // namespace plait::api
