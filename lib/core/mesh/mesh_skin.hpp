// Which bones move the vertices of a mesh, and where that brings them.
#pragma once

#include "base/result.hpp"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace plait {

using BoneMatrix = std::array<float, 12>; // 3x4 row-major
using BoneIndices = std::array<uint32_t, 4>;
using BoneWeights = std::array<float, 4>;

inline constexpr BoneMatrix identity_bone{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
inline constexpr uint32_t max_mesh_bones = 65536;

struct MeshBone {
    std::array<char, 64> name{};             // ends with 0
    BoneMatrix inverse_bind = identity_bone; // m: from the mesh at rest to the bone
    bool operator==(const MeshBone&) const = default;
};

// `name` cut between characters of UTF-8 where it is too long.
std::array<char, 64> bone_name(std::string_view name);

struct MeshSkin {
    explicit MeshSkin(std::pmr::memory_resource* memory)
        : indices(memory), weights(memory), bones(memory) {}
    bool empty() const { return indices.empty(); }

    std::pmr::vector<BoneIndices> indices; // [vertices] or empty
    std::pmr::vector<BoneWeights> weights; // likewise; sum 1
    std::pmr::vector<MeshBone> bones;      // all that are known
};

// Sum over bones of how much the weights of two vertices differ, [0, 2].
double skin_difference(const MeshSkin& a, size_t vertex_a, const MeshSkin& b, size_t vertex_b);

// Of sum 1.
BoneWeights normalized(const BoneWeights& weights);

// Linear blend: `rest` through the skin, whose bones are `bones`, into `positions` (m, xyz). `skin` is
// not empty. INVALID_ARGUMENT, before anything is written: bones too few, not finite, singular or
// reflecting.
Status pose_mesh(std::span<const std::array<float, 3>> rest, const MeshSkin& skin,
                 std::span<const BoneMatrix> bones, float* positions);

} // namespace plait
