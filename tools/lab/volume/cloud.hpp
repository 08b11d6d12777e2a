// Hair as the methods see it: vertices with masses, and a grid of nodes around them.
#pragma once

#include "common.hpp"

#include <cstdint>
#include <vector>

namespace lab::volume {

struct Cloud {
    std::vector<Vec3> x, v;     // m, m/s
    std::vector<double> mass;   // kg
    std::vector<double> wanted; // kg/m^3: how dense hair was around a vertex in the groom
    std::vector<char> moves;    // not a root
    size_t size() const { return x.size(); }
};

struct Cube {
    Vec3 origin;    // corner, m
    double edge;    // m
    uint32_t nodes; // along an edge
    double voxel() const { return edge / nodes; }
};

// Node n is the middle of a voxel. Sums of hair around nodes, with trilinear weights.
class Nodes {
  public:
    // `closed_radius`, m: nodes within it of the origin are closed; 0: none are.
    Nodes(const Cube& cube, double closed_radius);

    void add_up(const Cloud& cloud); // mass, momentum and wanted density; what was there is gone

    struct Corner {
        size_t node;
        double weight;
    };
    // The eight nodes around x; none at the border and outside.
    std::vector<Corner> around(const Vec3& x) const;

    double density(size_t node) const { return mass_[node] / cell_; }
    double wanted(size_t node) const;
    Vec3 velocity(size_t node) const;
    bool is_hair(size_t node) const; // open, and not nearly empty
    bool is_closed(size_t node) const { return closed_[node] != 0; }
    size_t count() const { return mass_.size(); }
    double voxel() const { return voxel_; }
    size_t stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? size_t{n_} * n_ : n_; }

    // function(node, colour) of every node but those of the border; neighbours differ in colour.
    template <typename Function> void for_each(Function function) const {
        for (uint32_t y = 1; y + 1 < n_; ++y)
            for (uint32_t z = 1; z + 1 < n_; ++z)
                for (uint32_t x = 1; x + 1 < n_; ++x)
                    function((size_t{y} * n_ + z) * n_ + x, (x + y + z) & 1);
    }
    // function(neighbour, axis, sign) across every open face of a node.
    template <typename Function> void for_each_face(size_t node, Function function) const {
        for (int axis = 0; axis < 3; ++axis)
            for (const int sign : {-1, 1}) {
                const size_t other = sign < 0 ? node - stride(axis) : node + stride(axis);
                if (!is_closed(other))
                    function(other, axis, sign);
            }
    }
    // -grad p / rho at nodes: of each axis the mean over its open faces, as plait has it. Kept
    // momenta of two nodes beside a face add up to 0.
    std::vector<Vec3> pull_of(const std::vector<double>& pressure) const;

    template <typename Value>
    Value gather(const std::vector<Value>& field, const Vec3& x, Value sum) const {
        for (const Corner& corner : around(x))
            sum += corner.weight * field[corner.node];
        return sum;
    }

  private:
    uint32_t n_;
    Vec3 origin_;
    double voxel_, cell_; // m, m^3
    std::vector<char> closed_;
    std::vector<double> mass_, wanted_;
    std::vector<Vec3> momentum_;
};

} // namespace lab::volume
