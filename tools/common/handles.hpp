// plait's objects, owned.
#pragma once

#include "common/failure.hpp"

#include <plait/plait_levels.h>
#include <plait/plait_offline.h>

#include <memory>

namespace common {

template <auto destroy> struct Destroyer {
    void operator()(auto* object) const { destroy(object); }
};
using ContextHandle = std::unique_ptr<plait_context, Destroyer<plait_context_destroy>>;
using GroomHandle = std::unique_ptr<plait_groom, Destroyer<plait_groom_destroy>>;
using LevelsHandle = std::unique_ptr<plait_levels, Destroyer<plait_levels_destroy>>;
using FollowMapHandle = std::unique_ptr<plait_follow_map, Destroyer<plait_follow_map_destroy>>;
using MeshHandle = std::unique_ptr<plait_mesh, Destroyer<plait_mesh_destroy>>;
using SimHandle = std::unique_ptr<plait_sim, Destroyer<plait_sim_destroy>>;

} // namespace common
