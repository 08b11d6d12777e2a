// Distances to a mesh at the nodes of a grid in its own frame, trilinear between them.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <plait/constants.h>

#include <algorithm>
#include <array>
#include <optional>

namespace plait::reference {

struct FieldSample {
    double distance;
    std::optional<Vec3> gradient; // where the distance is exact
};

class MeshField {
  public:
    template <typename Args>
    MeshField(const Args& args, size_t mesh)
        : values_(args.mesh_values), origin_(xyz(args.mesh_grid[mesh])),
          edge_(args.mesh_grid[mesh].w()) {
        for (size_t k = 0; k < 3; ++k) {
            nodes_[k] = args.mesh_nodes[4 * mesh + k];
            if (nodes_[k] < 2)
                throw BadDispatch(
                    format("mesh_nodes[%zu] is %zu, allowed from 2 on", 4 * mesh + k, nodes_[k]));
        }
        first_ = args.mesh_nodes[4 * mesh + 3];
    }

    double edge() const { return edge_; }
    // m: up to which distances are exact, and normals told.
    double room() const { return std::max(2 * edge_, double(PLAIT_MESH_ROOM)); }

    FieldSample at(const Vec3& x) const {
        const Vec3 cells = (x - origin_) / edge_;
        std::array<size_t, 3> cell{};
        Vec3 share, outside = Vec3::Zero();
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto axis = static_cast<size_t>(k);
            const double inside = std::clamp(cells[k], 0.0, double(nodes_[axis] - 1));
            outside[k] = cells[k] - inside;
            cell[axis] = std::min(static_cast<size_t>(inside), nodes_[axis] - 2);
            share[k] = inside - double(cell[axis]);
        }
        if (!outside.isZero(0))
            return {edge_ * (outside.norm() + 2), {}};
        double value = 0;
        Vec3 slope = Vec3::Zero();
        for (size_t corner = 0; corner < 8; ++corner) {
            const std::array<size_t, 3> upper{corner & 1, corner >> 1 & 1, corner >> 2};
            Vec3 weight, change;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const bool up = upper[static_cast<size_t>(k)] != 0;
                weight[k] = up ? share[k] : 1 - share[k];
                change[k] = up ? 1 : -1;
            }
            const double node =
                value_at(cell[0] + upper[0], cell[1] + upper[1], cell[2] + upper[2]);
            value += weight.prod() * node;
            slope += node * Vec3(change.x() * weight.y() * weight.z(),
                                 change.y() * weight.z() * weight.x(),
                                 change.z() * weight.x() * weight.y());
        }
        if (value > room())
            return {value, {}};
        return {value, Vec3(slope / edge_)};
    }

  private:
    double value_at(size_t x, size_t y, size_t z) const {
        return values_[first_ + (z * nodes_[1] + y) * nodes_[0] + x];
    }

    const View<const double>& values_;
    Vec3 origin_;
    double edge_;
    std::array<size_t, 3> nodes_{};
    size_t first_;
};

} // namespace plait::reference
