// Grids of distances, for the stages that meet meshes by them.
#pragma once

#include "mesh/mesh_inputs.hpp"

namespace plait::cases {

struct FieldMeshes {
    std::vector<float> rows, grid, values;
    std::vector<uint32_t> nodes;

    // A mesh without its row: a ball of 3 to 5 cm with a bulge, off the middle of its grid.
    void add(Random& random);
};

} // namespace plait::cases
