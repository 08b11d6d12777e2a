// Colliders that are meshes of form NEAREST: their triangles, a tree over them, and where their
// vertices are, which the caller may move, from the host or on the device. Where they are the device
// alone knows.
#pragma once

#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/mesh/mesh_tree.hpp"

#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Of all of them, in the order of their slots.
struct BendingBuffers {
    explicit BendingBuffers(std::pmr::memory_resource* memory) : insides(memory) {}

    Buffer first;     // uint [PLAIT_MESH_FIRST_STRIDE*meshes]
    Buffer box;       // float4 [2*nodes]
    Buffer way;       // float [nodes], m
    Buffer tree;      // uint [2*nodes]
    Buffer under;     // uint [PLAIT_MESH_UNDER_STRIDE*nodes]
    Buffer triangle;  // uint [PLAIT_MESH_TRIANGLE_STRIDE*triangles]
    Buffer ring;      // uint, per mesh [vertices + 1 + 3*triangles]
    Buffer from, to;  // float4 [vertices], m
    Buffer bends;     // float [meshes], m
    Buffer clearance; // float [vertices of the hair][meshes], m
    Buffer side;      // float4 [vertices of the hair][meshes]; 1 where none is a sheet
    std::pmr::vector<uint32_t> insides; // triangles of each; 0 of a sheet, which has no inside

    uint64_t bytes() const {
        uint64_t sum = 0;
        for (const Buffer* each : {&first, &box, &way, &tree, &under, &triangle, &ring, &from, &to,
                                   &bends, &clearance, &side})
            sum += each->bytes();
        return sum;
    }
};

class BendingMeshes {
  public:
    // Where vertices are: as of a collider's pose, of the call and of the fixed step.
    struct Places {
        explicit Places(std::pmr::memory_resource* memory)
            : at(memory), target(memory), from(memory), to(memory) {}
        std::pmr::vector<MeshPoint> at, target, from, to;
    };

    struct Entry {
        Entry(uint32_t slot, bool two_sided, std::pmr::memory_resource* memory);
        // Once the surface is there; places, where they are not filled, are its.
        void begin();
        size_t vertices() const { return surface.positions.size(); }

        uint32_t slot;
        bool two_sided;
        bool posed = false;                // its vertices have been moved
        TriangleSet surface;               // as it was made
        std::pmr::vector<float> clearance; // [guides][V]
        MeshTree tree;
        // Of a sheet, [guides][V][4], on the way to the device: which side each vertex is on; else empty.
        std::pmr::vector<float> sides;
        Places places;      // on the way to the device, and from one set of buffers to the next
        Buffer at, target;  // float4 [vertices]; target in metres
        float at_scale = 1; // times `at`: in the groom's units

        bool aimed = false;               // the target is not where they are
        bool there = true, still = true;  // the step's end is `at`; its begin its end
        bool fitted = false;              // boxes are those of the step
        bool poses = false, fits = false; // what a step has to do
        float part = 1;                   // of the call's way, where the step ends
    };
    using Entries = std::pmr::vector<Entry>;

    explicit BendingMeshes(std::pmr::memory_resource* memory)
        : entries_(memory), buffers_(memory) {}

    // Null: there are none.
    const BendingBuffers* buffers() const { return entries_.empty() ? nullptr : &buffers_; }
    std::span<const Entry> entries() const { return entries_; }
    uint64_t device_bytes() const;

    // Each waits for the device, and changes nothing if it fails.
    Status add(Device& device, Entry&& entry);
    Status remove(Device& device, uint32_t slot);
    Status assign(Device& device, Entries&& entries);
    // Where vertices are; of these the target, where there is one, in metres. Waits.
    Result<Places> read(Device& device, size_t index) const;

    // Of a sheet, on which side vertices are; waits.
    Result<std::pmr::vector<float>> read_sides(Device& device, size_t index) const;
    bool has_sheets() const;
    // Vertices are on the side where they are: all of one sheet, of all sheets, or those of all that are
    // `moved` [guides][V].
    Status forget_sides(Device& device, uint32_t slot);
    Status forget_sides(Device& device);
    Status forget_sides(Device& device, std::span<const unsigned char> moved);

    // Of the groom's units one is `scale` metres from now on; meshes keep their size in them.
    void rescale(float scale) { target_scale_ = 1 / scale; }
    // INVALID_ARGUMENT: not as many as the mesh has.
    Status check_count(uint32_t slot, size_t count) const;
    // m, of all of a mesh: where its vertices will be.
    Status set_positions(Device& device, uint32_t slot, std::span<const float> positions);
    // The same from a buffer on the device, `words` from one vertex to the next.
    void take_positions(Schedule& schedule, uint32_t slot, const Buffer& taken, uint32_t words);
    // As Colliders: the step's path ends at share `end` of the call's. append() is due.
    void advance(double end);
    // What moves them there; `all`: whatever any step may have to do.
    void append(Schedule& schedule, bool all) const;
    // Appends the planes of all of them, whose colliders are `rows`; after those of MeshColliders.
    void fill(Schedule& schedule, const Part& part, const ColliderRows& rows, Doors& doors) const;
    void arrive();
    void stop(Schedule& schedule);
    // One of them is where it was last put, and has taken no path there.
    void place(Schedule& schedule, uint32_t slot);
    // Boxes of meshes that no step has seen yet, for who looks before one does.
    void fit_new(Schedule& schedule);

  private:
    Entry& of(uint32_t slot);
    Status make(Device& device, std::span<Entry> entries, BendingBuffers& to) const;
    Status pull(Device& device);
    template <typename Forgets> Status forget_where(Device& device, const Forgets& forgets);
    // `aimed`: to its target; else to where it is.
    void append_pose(Schedule& schedule, const Entry& entry, size_t first, bool aimed,
                     float part) const;
    void append_fit(Schedule& schedule, const Entry& entry, uint32_t mesh) const;

    // It is where it was to be.
    void take_target(Entry& entry) const;

    Entries entries_;        // by slot
    float target_scale_ = 1; // times targets: in the groom's units
    BendingBuffers buffers_;
};

} // namespace plait
