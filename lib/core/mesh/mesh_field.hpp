// Signed distances to a mesh at the nodes of a grid, in the mesh's own frame; between nodes trilinear.
#pragma once

#include "core/mesh/mesh.hpp"

namespace plait {

struct MeshFieldRules {
    uint32_t cells = 48;    // along the longest side
    bool two_sided = false; // a sheet: all within a cell's edge of the surface is inside
};

struct MeshField {
    explicit MeshField(std::pmr::memory_resource* memory) : value(memory) {}

    std::array<float, 3> origin{};   // m, of node 0
    float edge = 0;                  // m, of a cell
    std::array<uint32_t, 3> nodes{}; // along x, y and z
    float band = 0;                  // m
    std::pmr::vector<float> value;   // m, x fastest, then y, then z; positive outside

    bool operator==(const MeshField&) const = default;
    size_t count() const { return size_t{nodes[0]} * nodes[1] * nodes[2]; }
    // Of a node.
    std::array<double, 3> place(size_t x, size_t y, size_t z) const;
};

// Distances up to `band`, and inside, are exact; beyond, outside, a node holds at least the band and
// at most its distance. The surface is at least the band inside the grid. INVALID_ARGUMENT: a mesh
// that has no inside and is not two-sided.
Status bake_field(const Mesh& mesh, const MeshFieldRules& rules, MeshField& field);

// INVALID_ARGUMENT: a mesh that has no inside.
Status check_sides(const Mesh& mesh);

// m, at a point of the mesh's frame; outside the grid at least its distance from it and the band.
double sample_field(const MeshField& field, const std::array<double, 3>& x);

} // namespace plait
