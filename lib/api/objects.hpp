// What the opaque handles of plait.h point to. Each begins with the memory it lives in.
#pragma once

#include "base/memory.hpp"
#include "core/follows/follow_learner.hpp"
#include "core/follows/follow_map.hpp"
#include "core/levels/levels.hpp"
#include "core/mesh/mesh.hpp"
#include "core/sim/sim.hpp"

#include <limits>
#include <string>

struct plait_context {
    plait::Context context;
    size_t users = 1;   // its handle, until destroyed, and its sims
    uint64_t lists = 0; // of sims that were given to it, counted

    plait_context(const plait::ContextRules& rules, plait::Device opened,
                  const plait_device_info& described)
        : context(rules, std::move(opened), described) {}
    plait::Memory& memory() { return context.memory; }
};

struct plait_groom {
    plait::Memory own;
    plait::Groom groom;
    std::string notes; // of its file

    explicit plait_groom(const plait_allocator& allocator)
        : own(allocator), groom{plait::StrandSet(&own), {}, {}} {}
    plait::Memory& memory() { return own; }
};

struct plait_follow_map {
    plait::Memory own;
    plait::FollowMap map;

    explicit plait_follow_map(const plait_allocator& allocator) : own(allocator), map(&own) {}
    plait::Memory& memory() { return own; }
};

struct plait_follow_learner {
    plait::Memory own;
    plait::FollowLearner learner;

    explicit plait_follow_learner(const plait_allocator& allocator)
        : own(allocator), learner(&own) {}
    plait::Memory& memory() { return own; }
};

struct plait_levels {
    plait::Memory own;
    plait::Levels levels;

    explicit plait_levels(const plait_allocator& allocator) : own(allocator), levels(&own) {}
    plait::Memory& memory() { return own; }
};

struct plait_mesh {
    plait::Memory own;
    plait::Mesh mesh;

    explicit plait_mesh(const plait_allocator& allocator) : own(allocator), mesh(&own) {}
    plait::Memory& memory() { return own; }
};

struct plait_sim {
    plait::Sim sim;
    plait_context& owner;
    uint64_t list = 0; // the last one that it was in, and where
    size_t place = 0;
    // s, for the director: since its choice; for which nobody has seen the hair
    double chosen_since = std::numeric_limits<double>::infinity();
    double unseen = 0;

    plait_sim(plait_context& context, plait::SimParts parts)
        : sim(context.context, std::move(parts)), owner(context) {
        ++owner.users;
    }
    ~plait_sim() { --owner.users; }
    plait::Memory& memory() { return owner.memory(); }
};

namespace plait::api {

// Deletes a handle whose memory resource may be inside it.
template <typename Handle> void destroy(Handle* handle) {
    if (!handle)
        return;
    Memory memory(handle->memory().allocator());
    DeleteIn<Handle>{&memory}(handle);
}

// A context goes with its last user.
inline void destroy_unused(plait_context* context) {
    if (context && context->users == 0)
        destroy(context);
}

} // namespace plait::api
