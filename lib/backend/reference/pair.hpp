// The cells in which segments are looked for: cubes that repeat in space.
#pragma once

#include "backend/reference/segment.hpp"

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

inline size_t number_of(const plait_pair_params& params, const Cell& cell) {
    const int64_t n = params.edge_count;
    if ((n & (n - 1)) != 0)
        throw BadDispatch(format("edge_count is %u, allowed are powers of two", params.edge_count));
    size_t number = 0;
    for (const int64_t at : {cell[2], cell[1], cell[0]})
        number = number * static_cast<size_t>(n) + static_cast<size_t>((at % n + n) % n);
    return number;
}

inline bool has_segment(const View<const uint32_t>& vertex_count, size_t vertex, uint32_t stride) {
    return vertex % stride + 1 < vertices_of(vertex_count, vertex / stride, stride);
}

} // namespace plait::reference
