// Linear blend skinning of the roots: one rigid pose per strand from four weighted bones.
#pragma once

#include "core/groom.hpp"

#include <span>

namespace plait {

using BoneMatrix = std::array<float, 12>; // 3x4 row-major

// What skinning needs of a groom, so that the groom itself may go.
struct Skin {
    explicit Skin(std::pmr::memory_resource* memory)
        : roots(memory), bone_indices(memory), bone_weights(memory) {}
    Skin(const Groom& groom, std::pmr::memory_resource* memory);

    uint32_t bones = 0;                      // 0: no skin
    std::pmr::vector<float> roots;           // xyz [strands], rest
    std::pmr::vector<uint32_t> bone_indices; // 4 [strands]
    std::pmr::vector<float> bone_weights;    // 4 [strands]
};

// The root itself follows the blend exactly; its frame turns by the rotation closest to the blend.
// INVALID_ARGUMENT if the blend of a strand has no closest rotation (rank below two).
Status skin_roots(const Skin& skin, std::span<const BoneMatrix> bones, std::span<plait_pose> poses);

} // namespace plait
