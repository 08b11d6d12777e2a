// Colliders that are meshes of form NEAREST: their triangles, a tree over them, and where their
// vertices are, which the caller may move.
#pragma once

#include "backend/device.hpp"
#include "core/mesh_tree.hpp"

#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Of all of them, in the order of their slots.
struct BendingBuffers {
    Buffer first;     // uint [PLAIT_MESH_FIRST_STRIDE*meshes]
    Buffer box;       // float4 [2*nodes]
    Buffer tree;      // uint [2*nodes]
    Buffer triangle;  // uint [PLAIT_MESH_TRIANGLE_STRIDE*triangles]
    Buffer ring;      // uint, per mesh [vertices + 1 + 3*triangles]
    Buffer from, to;  // float4 [vertices], m
    Buffer bends;     // float [meshes], m
    Buffer clearance; // float [vertices of the hair][meshes], m

    uint64_t bytes() const {
        uint64_t sum = 0;
        for (const Buffer* each :
             {&first, &box, &tree, &triangle, &ring, &from, &to, &bends, &clearance})
            sum += each->bytes();
        return sum;
    }
};

class BendingMeshes {
  public:
    struct Entry {
        Entry(uint32_t slot, bool two_sided, std::pmr::memory_resource* memory);
        // Once the surface is there.
        void begin();

        uint32_t slot;
        bool two_sided;
        bool posed = false;                               // its vertices have been moved
        TriangleSet surface;                              // as it was made
        std::pmr::vector<float> clearance;                // [guides][V]
        std::pmr::vector<MeshPoint> at, target, from, to; // as of a collider's pose
        MeshTree tree;
    };
    using Entries = std::pmr::vector<Entry>;

    explicit BendingMeshes(std::pmr::memory_resource* memory)
        : entries_(memory), scratch_(memory) {}

    // Null: there are none.
    const BendingBuffers* buffers() const { return entries_.empty() ? nullptr : &buffers_; }
    std::span<const Entry> entries() const { return entries_; }

    // Each waits for the device, and changes nothing if it fails.
    Status add(Device& device, Entry&& entry);
    Status remove(Device& device, uint32_t slot);
    Status assign(Device& device, Entries&& entries);

    // m, of all of a mesh: where its vertices will be.
    Status set_positions(uint32_t slot, std::span<const float> positions);
    // As Colliders: the step's path ends at share `end` of the call's. Uploads what moved.
    Status advance(Device& device, double end);
    void arrive();
    void stop();

  private:
    struct Scratch {
        explicit Scratch(std::pmr::memory_resource* memory)
            : boxes(memory), box(memory), from(memory), to(memory), bends(memory) {}
        std::pmr::vector<MeshTree::Box> boxes;
        std::pmr::vector<float> box, from, to, bends;
    };
    Status make(Device& device, std::span<const Entry> entries, BendingBuffers& to) const;
    Status upload(Device& device);

    Entries entries_; // by slot
    BendingBuffers buffers_;
    Scratch scratch_;
    bool uploaded_ = false;
};

} // namespace plait
