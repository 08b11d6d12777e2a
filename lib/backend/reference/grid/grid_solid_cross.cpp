// grid_solid_cross: lines of nodes that triangles of a mesh pass through, and between which nodes: a line
// along an axis passes through a triangle where its foot has no negative share of a corner.
#include "backend/reference/grid/mesh_solid.hpp"
#include "backend/reference/grid/volume.hpp"

#include <algorithm>
#include <cmath>

namespace plait::reference {
namespace {

// Lines, or nodes, from the first to the last corner along an axis.
std::array<size_t, 2> reach(const std::array<Vec3, 3>& corners, size_t axis, size_t n) {
    double low = double(n), high = 0;
    for (const Vec3& corner : corners) {
        low = std::min(low, corner[static_cast<Eigen::Index>(axis)]);
        high = std::max(high, corner[static_cast<Eigen::Index>(axis)] + 1);
    }
    return {static_cast<size_t>(std::clamp(low, 0.0, double(n))),
            static_cast<size_t>(std::clamp(std::ceil(high), 0.0, double(n)))};
}

// Where a line along `axis` through y, z of the other two passes through a triangle, in nodes. One that
// passes exactly through an edge is taken for one a little farther along y, and much less along z.
std::optional<double> crossing(const std::array<Vec3, 3>& corners, size_t axis, double y,
                               double z) {
    const auto x_axis = static_cast<Eigen::Index>(axis), y_axis = (x_axis + 1) % 3,
               z_axis = (x_axis + 2) % 3;
    const auto doubled_area = [&](const Vec3& edge, const Vec3& from, double to_y, double to_z) {
        return edge[y_axis] * (to_z - from[z_axis]) - edge[z_axis] * (to_y - from[y_axis]);
    };
    const double all =
        doubled_area(corners[1] - corners[0], corners[0], corners[2][y_axis], corners[2][z_axis]);
    double x = 0;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3& from = corners[(k + 1) % 3];
        const Vec3 edge = corners[(k + 2) % 3] - from;
        const double area = doubled_area(edge, from, y, z);
        const double farther = edge[z_axis] != 0 ? -edge[z_axis] : edge[y_axis];
        if (!((area != 0 ? area : farther) / all > 0))
            return {};
        x += area / all * corners[k][x_axis];
    }
    return x;
}

} // namespace

void grid_solid_cross(uint32_t item_count, const plait_grid_solid_cross_params& params,
                      const grid_solid_cross_args& args) {
    const NodeGrid grid(params.edge_count);
    const Pose pose{quat(params.q), vec3(params.t)};
    const MeshSolid mesh(args, params.mesh, params.collider_first);
    const size_t n = params.edge_count;
    const auto pass = [&](size_t axis, size_t y, size_t z, double x, size_t triangle) {
        std::array<size_t, 3> cell{};
        cell[(axis + 1) % 3] = y;
        cell[(axis + 2) % 3] = z;
        const auto behind = static_cast<size_t>(std::clamp(std::ceil(x), 0.0, double(n)));
        const auto met_at = [&](size_t place) -> uint32_t& {
            cell[axis] = place;
            return args.mesh_met[grid.index(cell)];
        };
        const auto mark = static_cast<uint32_t>(triangle + 1);
        if (behind > 0)
            met_at(behind - 1) = std::max(met_at(behind - 1), mark);
        if (behind == n)
            return;
        met_at(behind) = std::max(met_at(behind), mark);
        if (axis == 0)
            args.mesh_passed[grid.index(cell) / 32] ^= 1u << grid.index(cell) % 32;
    };
    for (size_t triangle = 0; triangle < item_count; ++triangle) {
        auto corners = mesh.corners(triangle);
        for (Vec3& corner : corners)
            corner = pose.invert(corner) / params.voxel_edge - Vec3::Constant(0.5);
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto ys = reach(corners, (axis + 1) % 3, n),
                       zs = reach(corners, (axis + 2) % 3, n);
            for (size_t z = zs[0]; z < zs[1]; ++z)
                for (size_t y = ys[0]; y < ys[1]; ++y)
                    if (const auto x = crossing(corners, axis, double(y), double(z)))
                        pass(axis, y, z, *x, triangle);
        }
    }
}

} // namespace plait::reference
