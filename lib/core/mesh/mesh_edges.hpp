// Which triangles of a mesh share an edge, and what follows from it: sides, components, volume.
#pragma once

#include "core/mesh/mesh.hpp"

#include <span>

namespace plait {

class MeshEdges {
  public:
    // One side of a triangle: from its corner `corner` to the next.
    struct Side {
        uint32_t low, high; // the edge's vertices
        uint32_t triangle;
        uint8_t corner;
        bool forward; // from low to high
    };

    MeshEdges(std::span<const Triangle> triangles, std::pmr::memory_resource* memory);

    size_t count() const { return first_.size() - 1; }
    std::span<const Side> edge(size_t index) const { // its sides
        return std::span(sides_).subspan(first_[index], first_[index + 1] - first_[index]);
    }
    size_t edge_of(size_t triangle, size_t corner) const { return edge_[3 * triangle + corner]; }
    // After triangles were turned over: their corners 1 and 2 exchanged.
    void turn_over(std::span<const uint8_t> turned);
    // Two triangles, each on the other's side of it.
    static bool agree(std::span<const Side> sides) {
        return sides.size() == 2 && sides[0].forward != sides[1].forward;
    }

  private:
    std::pmr::vector<Side> sides_;     // by edge
    std::pmr::vector<uint32_t> first_; // [edges + 1]
    std::pmr::vector<uint32_t> edge_;  // [triangles][3]
};

// Turns triangles so that neighbours agree on which side is outside, and closed components so that
// their volume is positive, unless they may be a hollow in another; returns those that it turned.
std::pmr::vector<Triangle> turn_outward(MeshEdges& edges, TriangleSet& surface,
                                        std::pmr::memory_resource* memory);

// Fills mesh.shape.
void measure_mesh(const MeshEdges& edges, Mesh& mesh);

} // namespace plait
