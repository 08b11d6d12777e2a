// The inter-hair grid: world to voxel, tent weights and velocities in the grid's frame.
#pragma once

#include "backend/reference/base/stages.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace plait::reference {

struct Node {
    size_t voxel;
    double weight;
};

class Grid {
  public:
    explicit Grid(const plait_grid_params& params);
    explicit Grid(const plait_lane_grid_params& params);
    explicit Grid(const plait_lane_volume_params& params); // trilinear

    // Grid coordinates in voxel units: conj(q) (x - t) / e.
    Vec3 coordinates(const Vec3& x) const;
    // The voxel that holds `p`: y nv^2 + z nv + x (thesis, figure 4.1); none outside the grid.
    std::optional<size_t> voxel_at(const Vec3& p) const;
    // Tent of equation 4.1 on the voxel that holds p: 1 at its centre, 0 at its faces.
    static double voxel_tent(const Vec3& p);
    // The voxels a vertex at `p` inside the grid counts in, by params.tent. With
    // PLAIT_TENT_TRILINEAR p is clamped to the outermost voxel centres, so the weights sum to 1.
    struct Nodes {
        std::array<Node, 8> node;
        size_t count = 0;
    };
    Nodes nodes(const Vec3& p) const;
    // (position - position_prev) / h in the grid's frame.
    Vec3 velocity(const Vec4& position, const Vec4& position_prev) const;
    Vec3 to_world(const Vec3& vector) const { return pose_.q * vector; }
    Vec3 components(const Vec3& vector) const { return pose_.q.conjugate() * vector; }

  private:
    size_t index(const Eigen::Array3i& cell) const;
    bool inside(const Eigen::Array3i& cell) const;

    Pose pose_;
    double voxel_edge_;
    double h_;
    int edge_count_;
    uint32_t tent_;
};

// What a vertex at `x` adds to the sums; `v` along the grid's axes. See grid_splat.cpp.
void add_to_sums(const Grid& grid, const Vec3& x, const Vec3& v, const View<uint32_t>& grid_sum,
                 const View<uint32_t>& grid_outside);

// `v`, along the grid's axes, of a vertex at `x`, braked where it outruns the hair around it; see
// grid_diffuse.cpp. Params: plait_grid_params or plait_lane_grid_params.
template <typename Params>
Vec3 diffused(const Grid& grid, const Params& params, const Vec3& x, const Vec3& v,
              const View<const double>& grid_density, const View<const Vec4>& grid_velocity);

} // namespace plait::reference
