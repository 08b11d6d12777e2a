// The grid on which pressure acts: neighbours of its nodes.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace plait::reference {

class NodeGrid {
  public:
    explicit NodeGrid(uint32_t edge_count) : count_(edge_count) {}

    size_t index(const std::array<size_t, 3>& cell) const { // along x, y, z
        return (cell[1] * count_ + cell[2]) * count_ + cell[0];
    }
    std::array<size_t, 3> cell(size_t node) const {
        return {node % count_, node / (count_ * count_), node / count_ % count_};
    }
    // In voxels, from the grid's corner.
    Vec3 centre(size_t node) const {
        const auto at = cell(node);
        return Vec3(double(at[0]), double(at[1]), double(at[2])) + Vec3::Constant(0.5);
    }
    // The neighbour on a side, -1 or 1, along an axis.
    std::optional<size_t> neighbour(size_t node, size_t axis, int side) const {
        auto at = cell(node);
        if (side < 0 ? at[axis] == 0 : at[axis] + 1 == count_)
            return std::nullopt;
        at[axis] += side < 0 ? -1 : 1;
        return index(at);
    }
    bool outermost(size_t node) const {
        for (const size_t place : cell(node))
            if (place == 0 || place + 1 == count_)
                return true;
        return false;
    }

  private:
    size_t count_;
};

// Of the face between a node and its neighbour; of the links that a node has with the next.
template <typename Links>
double link_between(const Links& links, size_t node, size_t neighbour, size_t axis) {
    return links[std::min(node, neighbour)][static_cast<Eigen::Index>(axis)];
}

} // namespace plait::reference
