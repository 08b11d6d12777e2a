// A tree of boxes over the triangles of a mesh whose vertices move: the tree stays, boxes follow (mesh_refit).
#pragma once

#include "core/mesh/mesh.hpp"

#include <span>

namespace plait {

class MeshTree {
  public:
    // The first child of a node is the next node.
    struct Node {
        uint32_t first;  // triangle in order(), or the second child
        uint32_t number; // of triangles; 0: it has children
    };
    struct Under {
        uint32_t first, triangles; // in order()
        uint32_t nodes;            // and itself: they come after it, one after another
    };

    explicit MeshTree(std::pmr::memory_resource* memory)
        : nodes_(memory), order_(memory), under_(memory) {}

    // By the middles of the triangles; the same for the same surface.
    void build(const TriangleSet& surface);

    std::span<const Node> nodes() const { return nodes_; }
    std::span<const uint32_t> order() const { return order_; } // triangles, leaf by leaf
    std::span<const Under> under() const { return under_; }    // nodes

  private:
    void add_node(const TriangleSet& surface, uint32_t first, uint32_t last);

    std::pmr::vector<Node> nodes_;
    std::pmr::vector<uint32_t> order_;
    std::pmr::vector<Under> under_;
};

} // namespace plait
