// A tree of boxes over the triangles of a mesh whose vertices move: the tree stays, boxes follow.
#pragma once

#include "core/mesh.hpp"

#include <span>

namespace plait {

class MeshTree {
  public:
    // The first child of a node is the next node.
    struct Node {
        uint32_t first;  // triangle in order(), or the second child
        uint32_t number; // of triangles; 0: it has children
    };
    struct Box {
        MeshPoint low, high;
    };

    explicit MeshTree(std::pmr::memory_resource* memory) : nodes_(memory), order_(memory) {}

    // By the middles of the triangles; the same for the same surface.
    void build(const TriangleSet& surface);

    std::span<const Node> nodes() const { return nodes_; }
    std::span<const uint32_t> order() const { return order_; } // triangles, leaf by leaf
    // Of every node, around all that lies in it in two places of its vertices and on the way; a
    // little larger, so that rounding leaves nothing outside.
    void fit(std::span<const Triangle> triangles, std::span<const MeshPoint> from,
             std::span<const MeshPoint> to, std::pmr::vector<Box>& boxes) const;

  private:
    void add_node(const TriangleSet& surface, uint32_t first, uint32_t last);

    std::pmr::vector<Node> nodes_;
    std::pmr::vector<uint32_t> order_;
};

} // namespace plait
