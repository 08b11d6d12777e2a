// Colliders and their paths; ids are generational, so a stale one is refused.
#pragma once

#include "backend/device.hpp"
#include "core/base/pose.hpp"
#include "core/contact/hull.hpp"

#include <memory_resource>
#include <vector>

namespace plait {

class Colliders {
  public:
    Colliders(uint32_t substeps, std::pmr::memory_resource* memory)
        : substeps_(1, substeps, memory), slots_(memory), faces_(memory), packed_(memory),
          packed_shown_(memory) {}

    // The numbers of substeps in which a fixed step is taken, by some strands or others.
    Status set_substeps(Device& device, std::span<const uint32_t> numbers);

    Result<plait_collider_id> create(Device& device, const plait_collider_desc& desc);
    // A mesh, of which only pose, friction and form are kept here: see MeshColliders, BendingMeshes.
    Result<plait_collider_id> create_mesh(Device& device, const plait_collider_mesh_desc& desc);
    // Faces of a hull are its own; the rest of its slot is that of a box around it.
    Result<plait_collider_id> create_hull(Device& device, const plait_collider_hull_desc& desc,
                                          const Hull& hull);
    Result<uint32_t> find(plait_collider_id id) const; // its slot
    Status set_pose(plait_collider_id id, const plait_pose& pose);
    Status place(plait_collider_id id, const plait_pose& pose); // it takes no path there
    // Shape and friction of `desc`, its pose not.
    Status set_shape(plait_collider_id id, const plait_collider_desc& desc);
    Status destroy(plait_collider_id id);
    // One that create() made last and nobody knows of: as if it had not been.
    void undo(plait_collider_id id);

    Result<plait_collider_desc> describe(plait_collider_id id) const; // at its target
    size_t list(std::span<plait_collider_id> dst) const; // as many as fit; their number

    uint32_t count() const { return count_; }
    uint32_t meshes() const { return meshes_; }   // of these
    uint32_t bending() const { return bending_; } // and of these those of form NEAREST
    // float4 [all substeps, one number of them after the other][count][PLAIT_COLLIDER_STRIDE], the
    // meshes last, and of these those of form NEAREST; then the faces of all hulls
    const Buffer& buffer() const { return buffer_; }
    // The same of one substep at whose end, as at its begin, each is where show() had it: that of the
    // step's path until it has been called.
    const Buffer& shown() const { return shown_ ? shown_ : buffer_; }
    uint64_t device_bytes() const { return buffer_.bytes() + shown_.bytes(); }

    // As Roots: the step's path ends at share `end` of the call's, and `bends` if theirs does. Uploads
    // what moved.
    Status advance(Device& device, double end, bool bends);
    // The path as it is, where the device does not have it yet.
    Status upload(Device& device);
    // Where each is now, as Roots::append_poses_now() has the head; uploads what differs from the last
    // time. The step's path stays as it is.
    Status show(Device& device);
    void arrive();
    void stop();   // no path: every collider is where it is now
    void place() { // at once where it was aimed at
        arrive();
        stop();
    }
    void jump(double end);                // no path to share `end` of the call's
    void carry(const plait_pose& motion); // the step's path so far, as Roots
    // Of the groom's units one is `scale` metres from now on, and the head is so much elsewhere: each
    // collider is to it as it was.
    void rescale(float scale, const HeadWays& ways);

    struct Slot {
        uint32_t generation = 0;
        uint32_t alive = 0;
        // the shape, as the fields of plait_collider_desc
        uint32_t kind = 0;
        uint32_t form = 0; // of a mesh; of capsule, box and hull 1: inward
        float a[3] = {};
        float b[3] = {};
        float radius_a = 0;
        float radius_b = 0;
        float friction = 0;
        float normal[3] = {};
        float half_extents[3] = {};
        float rounding = 0;
        float orientation[4] = {};
        float scale = 0;                   // 0: that of the roots
        plait_pose target = identity_pose; // of the call, in metres of the world
        // All others are in the groom's units.
        plait_pose at = identity_pose;                       // of the call
        plait_pose from = identity_pose, to = identity_pose; // of the step
        plait_pose before = identity_pose; // where the step before began: the path bends through it
    };
    static bool bends(const Slot& slot) {
        return is_mesh(slot) && slot.form == PLAIT_MESH_FORM_NEAREST;
    }
    static bool is_mesh(const Slot& slot) {
        return slot.alive && slot.kind == PLAIT_COLLIDER_KIND_MESH;
    }
    static bool is_hull(const Slot& slot) {
        return slot.alive && slot.kind == PLAIT_COLLIDER_KIND_HULL;
    }
    static bool is_inward(const Slot& slot) {
        return slot.form != 0 && !is_mesh(slot) && slot.kind != PLAIT_COLLIDER_KIND_PLANE;
    }
    static plait_collider_desc shape_of(const Slot& slot); // its pose is zero
    std::span<const Slot> slots() const { return slots_; }
    // Its target, in the groom's units.
    plait_pose goal(const Slot& slot) const { return in_units(slot.target, scale_); }
    using Faces = std::pmr::vector<HullFace>;
    using FacesOf = std::pmr::vector<Faces>; // [slots], of what is no hull none
    const FacesOf& faces() const { return faces_; }
    // What fails changes nothing.
    Status assign(Device& device, std::span<const Slot> slots, FacesOf&& faces, float scale);
    // Those of another sim, each where it was sent last, on no way.
    Status take(Device& device, const Colliders& from);
    // Whether ids and shapes are these.
    bool are(std::span<const Slot> slots, const FacesOf& faces) const;

  private:
    Slot& take_slot(const plait_pose& pose);
    Status reserve(Device& device, size_t count, size_t faces);
    plait_pose on_path(const Slot& slot, double share) const;
    // Lengths of its shape are so many of the groom's units for each that it says.
    float size(const Slot& slot) const { return slot.scale == 0 ? 1 : slot.scale / scale_; }
    void pack_faces(std::span<float> packed, size_t rows) const;
    size_t rows(size_t count) const; // of their paths

    std::pmr::vector<uint32_t> substeps_;
    std::pmr::vector<Slot> slots_;
    FacesOf faces_;
    std::pmr::vector<float> packed_;       // scratch for uploads
    std::pmr::vector<float> packed_shown_; // what shown_ holds
    uint32_t count_ = 0, meshes_ = 0, bending_ = 0;
    size_t face_count_ = 0; // of all hulls
    float scale_ = 1;       // m, one of the groom's units
    bool bends_ = false;    // the step's path, as that of the roots
    bool uploaded_ = false; // the buffer holds the step's path
    Buffer buffer_, shown_; // the latter from the first show() on
};

} // namespace plait
