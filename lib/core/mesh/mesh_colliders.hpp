// What colliders that are meshes have beside their slot in Colliders: the grid of distances, and how
// far outside of the surface each vertex meets them.
#pragma once

#include "backend/device.hpp"
#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/mesh/mesh_field.hpp"

#include <functional>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Of all meshes, in the order of their slots. It is the same for all hair, so that sims that share bodies
// hold it once.
struct FieldGeometry {
    Buffer grid;   // float4 [meshes]: origin, edge of a cell
    Buffer nodes;  // uint [4*meshes]: along x, y, z; where in `values` they begin
    Buffer values; // float, m

    uint64_t bytes() const { return grid.bytes() + nodes.bytes() + values.bytes(); }
};
struct MeshBuffers {
    std::shared_ptr<const FieldGeometry> fields;
    Buffer clearance; // float [vertices][meshes], m

    // Of `fields` the part of one of those that hold it.
    uint64_t bytes() const {
        return fields->bytes() / static_cast<uint64_t>(fields.use_count()) + clearance.bytes();
    }
};

// How far outside of a mesh hair is held.
struct ClearanceRules {
    float margin = 0;        // m
    uint32_t keeps_rest = 0; // 1: no vertex is farther out than it is at rest
    bool operator==(const ClearanceRules&) const = default;
};

class MeshColliders {
  public:
    struct Entry {
        uint32_t slot;
        std::shared_ptr<const MeshField> field;
        ClearanceRules rules;
        std::pmr::vector<float> clearance; // [guides][V]
    };
    using Entries = std::pmr::vector<Entry>;
    struct Set {
        explicit Set(Entries&& list) : entries(std::move(list)) {}
        Entries entries; // by slot
        MeshBuffers buffers;
    };

    explicit MeshColliders(std::pmr::memory_resource* memory) : set_(Entries(memory)) {}

    // Null: there are none.
    const MeshBuffers* buffers() const { return set_.entries.empty() ? nullptr : &set_.buffers; }
    std::span<const Entry> entries() const { return set_.entries; }
    const Set& set() const { return set_; }

    // The entries with one more, or without one.
    Entries with(Entry&& entry) const;
    Entries without(uint32_t slot) const;
    // Made aside; the geometry of `like` where it has the same fields. Waits.
    Result<Set> make(Device& device, Entries&& entries, const Set& like) const;
    void swap(Set& set) { std::swap(set_, set); }

    // Appends the planes of all of them, whose colliders are `rows`.
    void fill(Schedule& schedule, const Part& part, const ColliderRows& rows, Doors& doors) const;

  private:
    Set set_;
};

// Where vertices are at rest, in the world, and the mesh.
struct ClearanceInput {
    // m, of a point in the mesh's own frame, negative inside
    const std::function<double(const std::array<double, 3>&)>& distance;
    plait_pose pose;              // of the mesh
    std::span<const float> rest;  // float4 [guides][V], in the groom's space
    std::span<const float> roots; // poses [guides][PLAIT_POSE_STRIDE] float4
    uint32_t row;                 // V
    ClearanceRules rules;
};

// m outside of the surface, by vertex: the margin, or less.
std::pmr::vector<float> measure_clearance(const ClearanceInput& input,
                                          std::pmr::memory_resource* memory);

} // namespace plait
