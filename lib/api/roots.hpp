// A plait_roots of the caller's, checked and copied.
#pragma once

#include "core/sim/sim.hpp"

namespace plait::api {

// Owns what a plait_roots names.
struct RootsCopy {
    explicit RootsCopy(std::pmr::memory_resource* memory)
        : own(memory), bones(memory), mesh(memory) {}
    plait_pose head{};
    float scale = 1;
    std::pmr::vector<plait_pose> own;
    std::pmr::vector<BoneMatrix> bones;
    std::pmr::vector<MeshPoint> mesh;

    RootsInput input() { return {{head, scale, own}, bones, mesh}; }
};

plait_roots default_roots();
// INVALID_ARGUMENT names the field, the place, the value and the range; counts are not checked.
Status read_roots(const plait_roots* given, RootsCopy& copy);

} // namespace plait::api
