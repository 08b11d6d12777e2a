// Signed distance to a mesh, exactly: the nearest triangle by a tree of boxes, on which side by the
// pseudonormal of the nearest face, edge or corner.
// Source: Baerentzen & Aanaes 2005 (pseudonormals: of an edge the sum of its faces' normals, of a
// corner that of the normals weighed by their angles there); Ericson 2005, 5.1.5 (nearest point).
#pragma once

#include "core/mesh/mesh.hpp"

#include <Eigen/Core>

namespace plait {

struct MeshNearest {
    double distance = 0;     // m, >= 0
    bool inside = false;     // below the pseudonormal; of what is open this means little
    Eigen::Vector3d point;   // on the surface
    Eigen::Vector3d outward; // the unit pseudonormal there
    uint32_t triangle = 0;   // of equally near ones, the one that was found first

    double signed_distance() const { return inside ? -distance : distance; }
};

class MeshDistance {
  public:
    // Reads `surface` for as long as it lives.
    MeshDistance(const TriangleSet& surface, std::pmr::memory_resource* memory);

    // `hint`: a triangle that may be near.
    MeshNearest nearest(const Eigen::Vector3d& x, uint32_t hint = 0) const;

  private:
    using Vec3 = Eigen::Vector3d;
    // A node has two children, the first just after it, or triangles.
    struct Node {
        Vec3 low, high;
        uint32_t first;  // triangle in order_, or the second child
        uint32_t number; // of triangles; 0: it has children
    };
    struct Features {
        Vec3 face;
        std::array<Vec3, 3> edge; // from corner k to the next
    };
    static const Features no_features;
    struct Found;

    uint32_t build(uint32_t first, uint32_t last);
    void measure(Node& node, uint32_t first, uint32_t last) const;
    void try_triangle(uint32_t triangle, const Vec3& x, Found& found) const;
    void search(const Vec3& x, Found& found) const;
    Vec3 corner(uint32_t triangle, size_t k) const;

    const TriangleSet& surface_;
    std::pmr::vector<Node> nodes_;
    std::pmr::vector<uint32_t> order_;    // triangles, leaf by leaf
    std::pmr::vector<Features> features_; // of triangles
    std::pmr::vector<Vec3> corners_;      // pseudonormals of vertices
};

} // namespace plait
