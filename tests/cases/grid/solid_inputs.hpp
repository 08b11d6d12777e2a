// Meshes in a grid of nodes around the origin, for the stages that find which nodes lie in them.
#pragma once

#include "mesh/mesh_inputs.hpp"

#include <algorithm>

namespace plait::cases {

constexpr double solid_edge = 0.2; // m, of the grid

// Where the grid is, of the structs that say so.
template <typename Params> void put_solid_grid(Params& params, uint32_t edge_count) {
    Random random(edge_count);
    const auto q = random.rotation();
    params.edge_count = edge_count;
    std::copy(q.begin(), q.end(), params.q);
    if constexpr (requires { params.voxel_edge; }) {
        params.voxel_edge = static_cast<float>(solid_edge / edge_count);
        const Point corner =
            rotate(q, {-0.47 * solid_edge, -0.52 * solid_edge, -0.55 * solid_edge});
        std::copy(corner.begin(), corner.end(), params.t);
    }
}

// The row in `collider` of a mesh within a few centimetres of the origin, that moves and turns.
void add_solid_row(std::vector<float>& rows, Random& random, std::array<double, 2> shares);

// What no such stage reads of a row.
std::vector<std::string> solid_unread();

} // namespace plait::cases
