// Sizes that the parameters of stages and the contents of their buffers have in common, and what kinds of
// stages there are.
#pragma once

#include "ball.hpp"
#include "inputs.hpp"

namespace bench {

inline constexpr uint32_t grid_edge_count = 8; // as in Ugurca 2015
inline constexpr uint32_t slot_capacity = 1024;
inline constexpr uint32_t colliders = 4;
inline constexpr uint32_t bones = 64, skin_vertices = 3000;
inline constexpr uint32_t pair_cells = 32;  // each way
inline constexpr uint32_t most_runs = 1024; // of bounds
inline constexpr uint32_t slots_in_parallel = 64;
inline constexpr float step = 1.0f / 60.0f; // s
inline constexpr float grid_size = 4 * (head_radius + strand_length);

inline constexpr uint32_t voxels = grid_edge_count * grid_edge_count * grid_edge_count;

// The mesh that hair is near: a ball of 2,048 triangles, as large as the head.
const Ball& ball();

bool follows_meet_meshes(plait_stage stage);
bool finds_solids(plait_stage stage);
bool finds_planes(plait_stage stage);

} // namespace bench
