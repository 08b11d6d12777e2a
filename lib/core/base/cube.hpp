// A cube in rest space: what a grid covers when the caller gives none.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace plait {

struct GridCube {
    float origin[3]; // corner, m
    float edge;      // whole, m

    std::array<float, 3> middle() const {
        return {origin[0] + 0.5f * edge, origin[1] + 0.5f * edge, origin[2] + 0.5f * edge};
    }
};

// Half as large again as the box from `low` to `high`, so that hair can swing.
inline GridCube cube_around(const std::array<float, 3>& low, const std::array<float, 3>& high) {
    GridCube cube{};
    for (size_t i = 0; i < 3; ++i)
        cube.edge = std::max(cube.edge, 1.5f * (high[i] - low[i]));
    for (size_t i = 0; i < 3; ++i)
        cube.origin[i] = 0.5f * (low[i] + high[i]) - 0.5f * cube.edge;
    return cube;
}

} // namespace plait
