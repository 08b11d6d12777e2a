// How dense the groom's hair is at rest, on the grid of the inter-hair step.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

struct RestGrid {
    uint32_t edge_count = 0;
    float edge = 0; // whole, m
    std::array<float, 3> origin{};

    bool operator==(const RestGrid&) const = default;
};

// Of every vertex, strand after strand.
struct RestDensity {
    explicit RestDensity(std::pmr::memory_resource* memory) : hair(memory), density(memory) {}

    std::pmr::vector<float> hair;    // that it stands for: half of both segments, over the mean
    std::pmr::vector<float> density; // of such hair around it, per voxel; 0 outside the grid
};

// `positions`: xyz of every vertex, m; `counts`: vertices of each strand.
RestDensity measure_rest_density(std::span<const float> positions, std::span<const uint32_t> counts,
                                 const RestGrid& grid, std::pmr::memory_resource* memory);

} // namespace plait
