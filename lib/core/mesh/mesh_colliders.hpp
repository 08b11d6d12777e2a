// What colliders that are meshes have beside their slot in Colliders: the grid of distances, and how
// far outside of the surface each vertex meets them.
#pragma once

#include "backend/device.hpp"
#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/mesh/mesh_field.hpp"

#include <functional>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Of all meshes, in the order of their slots.
struct MeshBuffers {
    Buffer grid;      // float4 [meshes]: origin, edge of a cell
    Buffer nodes;     // uint [4*meshes]: along x, y, z; where in `values` they begin
    Buffer values;    // float, m
    Buffer clearance; // float [vertices][meshes], m

    uint64_t bytes() const {
        return grid.bytes() + nodes.bytes() + values.bytes() + clearance.bytes();
    }
};

class MeshColliders {
  public:
    struct Entry {
        uint32_t slot;
        MeshField field;
        std::pmr::vector<float> clearance; // [guides][V]
    };
    using Entries = std::pmr::vector<Entry>;

    explicit MeshColliders(std::pmr::memory_resource* memory) : entries_(memory) {}

    // Null: there are none.
    const MeshBuffers* buffers() const { return entries_.empty() ? nullptr : &buffers_; }
    std::span<const Entry> entries() const { return entries_; }

    // Each waits for the device, and changes nothing if it fails.
    Status add(Device& device, Entry&& entry);
    Status remove(Device& device, uint32_t slot);
    Status assign(Device& device, Entries&& entries);

    // Appends the planes of all of them, whose colliders are `rows`.
    void fill(Schedule& schedule, const Part& part, const ColliderRows& rows, Doors& doors) const;

  private:
    Entries entries_; // by slot
    MeshBuffers buffers_;
};

// Where vertices are at rest, in the world, and the mesh.
struct ClearanceInput {
    // m, of a point in the mesh's own frame, negative inside
    const std::function<double(const std::array<double, 3>&)>& distance;
    plait_pose pose;              // of the mesh
    std::span<const float> rest;  // float4 [guides][V], in the groom's space
    std::span<const float> roots; // poses [guides][PLAIT_POSE_STRIDE] float4
    uint32_t row;                 // V
    float margin;                 // m
    bool keeps_rest;              // no vertex is farther out than it is at rest
};

// m outside of the surface, by vertex: the margin, or less.
std::pmr::vector<float> measure_clearance(const ClearanceInput& input,
                                          std::pmr::memory_resource* memory);

} // namespace plait
