// Colliders that are meshes of form NEAREST: their triangles, a tree over them, and where their
// vertices are, which the caller may move, from the host or on the device. Where they are the device
// alone knows.
#pragma once

#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/mesh/mesh_colliders.hpp"
#include "core/mesh/mesh_tree.hpp"

#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// A mesh as it was made.
struct BendingSurface {
    BendingSurface(bool sheet, std::pmr::memory_resource* memory)
        : two_sided(sheet), set(memory), tree(memory) {}
    size_t vertices() const { return set.positions.size(); }

    bool two_sided;
    TriangleSet set;
    MeshTree tree;
};

// Of all of them, in the order of their slots: what does not change while they are there, and is the same
// for all hair, so that sims that share bodies hold it once.
struct SurfaceGeometry {
    explicit SurfaceGeometry(std::pmr::memory_resource* memory) : insides(memory) {}

    Buffer first;                       // uint [PLAIT_MESH_FIRST_STRIDE*meshes]
    Buffer tree;                        // uint [2*nodes]
    Buffer under;                       // uint [PLAIT_MESH_UNDER_STRIDE*nodes]
    Buffer triangle;                    // uint [PLAIT_MESH_TRIANGLE_STRIDE*triangles]
    Buffer ring;                        // uint, per mesh [vertices + 1 + 3*triangles]
    std::pmr::vector<uint32_t> insides; // triangles of each; 0 of a sheet, which has no inside

    uint64_t bytes() const {
        return first.bytes() + tree.bytes() + under.bytes() + triangle.bytes() + ring.bytes();
    }
};

// And what steps change, each sim in its own time.
struct BendingBuffers {
    std::shared_ptr<const SurfaceGeometry> surfaces;
    Buffer box;       // float4 [2*nodes]
    Buffer way;       // float [nodes], m
    Buffer from, to;  // float4 [vertices], m
    Buffer bends;     // float [meshes], m
    Buffer clearance; // float [vertices of the hair][meshes], m
    Buffer side;      // float4 [vertices of the hair][meshes]; 1 where none is a sheet

    // Of `surfaces` the part of one of those that hold it.
    uint64_t bytes() const {
        uint64_t sum = surfaces->bytes() / static_cast<uint64_t>(surfaces.use_count());
        for (const Buffer* each : {&box, &way, &from, &to, &bends, &clearance, &side})
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
        Entry(uint32_t slot, std::shared_ptr<const BendingSurface> surface,
              std::pmr::memory_resource* memory);
        // Places, where they are not filled, are those of the surface.
        void begin();
        size_t vertices() const { return surface->vertices(); }
        bool two_sided() const { return surface->two_sided; }

        uint32_t slot;
        bool posed = false; // its vertices have been moved
        std::shared_ptr<const BendingSurface> surface;
        ClearanceRules rules{};
        std::pmr::vector<float> clearance; // [guides][V]
        // Of a sheet, [guides][V][4], on the way to the device: which side each vertex is on; else empty.
        std::pmr::vector<float> sides;
        Places places; // on the way to the device, and from one set of buffers to the next
        std::shared_ptr<Buffer> at, target; // float4 [vertices]; target in metres
        float at_scale = 1;                 // times `at`: in the groom's units

        bool aimed = false;               // the target is not where they are
        bool there = true, still = true;  // the step's end is `at`; its begin its end
        bool fitted = false;              // boxes are those of the step
        bool poses = false, fits = false; // what a step has to do
        float part = 1;                   // of the call's way, where the step ends
    };
    using Entries = std::pmr::vector<Entry>;
    struct Set {
        explicit Set(Entries&& list) : entries(std::move(list)) {}
        Entries entries; // by slot
        BendingBuffers buffers;
    };

    explicit BendingMeshes(std::pmr::memory_resource* memory) : set_(Entries(memory)) {}

    // Null: there are none.
    const BendingBuffers* buffers() const { return set_.entries.empty() ? nullptr : &set_.buffers; }
    std::span<const Entry> entries() const { return set_.entries; }
    const Set& set() const { return set_; }
    uint64_t device_bytes() const;

    // The entries with one more, or without one, where they are now. Waits.
    Result<Entries> with(Device& device, Entry&& entry) const;
    Result<Entries> without(Device& device, uint32_t slot) const;
    // One of them for other hair, of whose units one is `scale` metres: where it was sent last. stop() puts
    // it there.
    Result<Entry> for_other_hair(Device& device, size_t index, float scale) const;
    // Made aside; the geometry of `like` where it has the same surfaces. Waits.
    Result<Set> make(Device& device, Entries&& entries, const Set& like) const;
    void swap(Set& set) { std::swap(set_, set); }
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
    // m, of all of a mesh, as float4. INVALID_ARGUMENT: a coordinate out of range.
    Result<std::pmr::vector<float>> rows_of(uint32_t slot, std::span<const float> positions) const;
    // Where its vertices will be: what rows_of() gives.
    Status set_positions(Device& device, uint32_t slot, std::span<const float> rows);
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
    template <typename Forgets> Status forget_where(Device& device, const Forgets& forgets);
    // `aimed`: to its target; else to where it is.
    void append_pose(Schedule& schedule, const Entry& entry, size_t first, bool aimed,
                     float part) const;
    void append_fit(Schedule& schedule, const Entry& entry, uint32_t mesh) const;

    // It is where it was to be.
    void take_target(Entry& entry) const;

    Set set_;
    float target_scale_ = 1; // times targets: in the groom's units
};

} // namespace plait
