// Surfaces of distance fields as triangles.
#pragma once

#include "vec.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace plait_generator {

struct Surface {
    std::vector<Vec3> points;
    std::vector<uint32_t>
        triangles; // 3 [triangles], counter-clockwise seen from where distance > 0
};

// Corner (i, j, k) of a grid that may be bent and graded at will, as long as cells do not turn
// over.
struct Grid {
    std::array<size_t, 3> corners; // along each axis
    std::function<Vec3(size_t i, size_t j, size_t k)> place;
};

// Naive surface nets (S. Gibson, "Constrained elastic surface nets", MICCAI 1998): one point per
// cell that the surface crosses, at the mean of its crossings with the cell's edges.
Surface surface_nets(const std::function<double(Vec3)>& distance, const Grid& grid);

} // namespace plait_generator
