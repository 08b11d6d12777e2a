// The cells in which segments are looked for: cubes that repeat in space.
#pragma once

#include "backend/reference/strand_contact/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace plait::reference {

using Cell = std::array<int64_t, 3>; // counted without end

inline Cell cell_of(const plait_pair_params& params, const Vec3& x) {
    Cell cell{};
    for (size_t k = 0; k < 3; ++k) {
        const double at = std::floor(x[static_cast<Eigen::Index>(k)] / double(params.voxel_edge));
        cell[k] = std::abs(at) < 1e9 ? static_cast<int64_t>(at) : 0; // not of what is not finite
    }
    return cell;
}

inline size_t number_of(const Cell& cell, int64_t n) {
    if ((n & (n - 1)) != 0)
        throw BadDispatch(
            format("edge_count is %d, allowed are powers of two", static_cast<int>(n)));
    size_t number = 0;
    for (const int64_t at : {cell[2], cell[1], cell[0]})
        number = number * static_cast<size_t>(n) + static_cast<size_t>((at % n + n) % n);
    return number;
}

// Of the block of cells that a cell is in.
inline size_t block_of(const plait_pair_params& params, const Cell& cell) {
    constexpr int64_t edge = PLAIT_PAIR_BLOCK;
    Cell block{};
    for (size_t k = 0; k < 3; ++k)
        block[k] = (cell[k] - (cell[k] % edge + edge) % edge) / edge;
    return number_of(block, std::max<int64_t>(params.edge_count / edge, 1));
}

inline bool has_segment(const View<const uint32_t>& vertex_count, size_t vertex, uint32_t stride) {
    return vertex % stride + 1 < vertices_of(vertex_count, vertex / stride, stride);
}

// From one component of cell_line to the next, of so many vertices.
inline size_t line_stride(size_t vertices) {
    return vertices + PLAIT_PAIR_PADDING;
}

} // namespace plait::reference
