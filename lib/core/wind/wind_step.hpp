// The wind as the strands of a substep meet it.
#pragma once

#include "backend/device.hpp"

#include <array>

namespace plait {

struct WindStep {
    float drag;                // rho d/2, kg/m^2
    float viscous;             // 10 (nu/d)^(2/3), (m/s)^(2/3)
    float tangential;          // drag along the strand over that across
    std::array<float, 3> air;  // m/s, what `velocity` does not hold
    std::array<float, 3> jump; // m/s, of it since the substep before
    const Buffer* velocity;    // float4 [nodes^3], m/s; null: the same everywhere
    uint32_t nodes;            // per edge of their grid
    float voxel_edge;          // m
    float q[4], t[3];          // the grid's orientation and corner in the world
};

} // namespace plait
