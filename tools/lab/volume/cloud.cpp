#include "cloud.hpp"

#include <algorithm>
#include <cmath>

namespace lab::volume {

Nodes::Nodes(const Cube& cube, double closed_radius)
    : n_(cube.nodes), origin_(cube.origin), voxel_(cube.voxel()), cell_(std::pow(voxel_, 3)),
      closed_(size_t{n_} * n_ * n_, 0), mass_(closed_.size(), 0.0) {
    for_each([&](size_t node, uint32_t) {
        const size_t column[] = {node % n_, node / (size_t{n_} * n_), node / n_ % n_};
        const Vec3 at(static_cast<double>(column[0]) + 0.5, static_cast<double>(column[1]) + 0.5,
                      static_cast<double>(column[2]) + 0.5);
        closed_[node] = (origin_ + voxel_ * at).norm() < closed_radius;
    });
}

std::vector<Nodes::Corner> Nodes::around(const Vec3& x) const {
    const Vec3 at = (x - origin_) / voxel_ - Vec3::Constant(0.5);
    if (!(at.minCoeff() >= 0 && at.maxCoeff() < n_ - 1))
        return {};
    std::vector<Corner> corners(8);
    const Vec3 low = at.array().floor(), share = at - low;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        size_t node = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int up = corner >> axis & 1;
            weight *= up ? share[axis] : 1 - share[axis];
            node += (static_cast<size_t>(low[axis]) + static_cast<size_t>(up)) * stride(axis);
        }
        corners[static_cast<size_t>(corner)] = {node, weight};
    }
    return corners;
}

void Nodes::add_up(const Cloud& cloud) {
    mass_.assign(closed_.size(), 0.0);
    wanted_.assign(closed_.size(), 0.0);
    momentum_.assign(closed_.size(), Vec3::Zero());
    for (size_t i = 0; i < cloud.size(); ++i)
        for (const auto& [node, weight] : around(cloud.x[i])) {
            const double mass = weight * cloud.mass[i];
            mass_[node] += mass;
            momentum_[node] += mass * cloud.v[i];
            wanted_[node] += mass * cloud.wanted[i];
        }
}

double Nodes::wanted(size_t node) const {
    return mass_[node] > 0 ? wanted_[node] / mass_[node] : 0;
}

Vec3 Nodes::velocity(size_t node) const {
    return mass_[node] > 0 ? Vec3(momentum_[node] / mass_[node]) : Vec3(Vec3::Zero());
}

bool Nodes::is_hair(size_t node) const {
    return !is_closed(node) && mass_[node] > 0 && density(node) > 0.05 * wanted(node);
}

std::vector<Vec3> Nodes::pull_of(const std::vector<double>& pressure) const {
    std::vector<Vec3> pull(mass_.size(), Vec3::Zero());
    for_each([&](size_t node, uint32_t) {
        if (is_closed(node) || mass_[node] <= 0)
            return;
        int faces[3] = {};
        for_each_face(node, [&](size_t other, int axis, int sign) {
            const double between = 0.5 * (density(node) + density(other));
            pull[node][axis] -= sign * (pressure[other] - pressure[node]) / (between * voxel_);
            ++faces[axis];
        });
        for (int axis = 0; axis < 3; ++axis)
            pull[node][axis] /= std::max(faces[axis], 1);
    });
    return pull;
}

} // namespace lab::volume
