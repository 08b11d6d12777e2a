// What a snapshot looks like, and what of it can be told without a sim.
#pragma once

#include "core/sim/sim.hpp"

#include <array>
#include <cstring>
#include <span>

namespace plait {

// A snapshot begins with this. Blocks follow, in the order of BlockKind, each behind a BlockHead: a
// feature that is off has none. A block has a version of its own, which rises when its bytes mean
// something else; a new feature adds a block and changes no other.
struct SnapshotHead {
    uint32_t magic;
    uint32_t version;  // of heads and of the order, not of what blocks hold
    uint64_t checksum; // of every byte after it
};
struct BlockHead {
    uint32_t tag;
    uint32_t version;
    uint64_t bytes; // that follow
};

enum class BlockKind : uint32_t {
    sim,      // SavedSim: what it is of, and its clock
    roots,    // SavedRoots, then poses of roots that have their own
    frame,    // Frame::State
    bodies,   // slots, faces of hulls, meshes by form
    settings, // SavedSettings of every guide, where strands have some of their own
    hair,     // positions and their history, poses, lanes
    output,   // the step before the last, where output is interpolated
    pins,
    wind,    // SavedWind
    wetness, // SavedWetness, then that of strands
    volume,  // SavedVolume, then the pressure of strands and of nodes
    contact, // normal forces of the last substep, of strands over lanes
    levels,  // SimLevels::Kept, then what is kept of strands that are shown
};
constexpr size_t block_kinds = 13;

struct SavedSim {
    uint64_t groom; // its fingerprint
    uint32_t model, guides, row, substeps;
    float step, scale; // s; m, one of the groom's units
    double waiting;    // s
    uint64_t steps, dropped;
    uint32_t bdf2,
        strand_contact; // Params::bdf2 and whether it was on: whether strands have a history
};
struct SavedRoots {
    plait_pose heads[5]; // at, target, from, to, before
    uint32_t own[5];
    uint32_t aimed;
    uint32_t bends; // Roots::samples()
    HeadMotion::State motion;
};
// Of a strand, as Settings has it.
struct SavedSettings {
    uint32_t substeps, iterations, bdf2;
};
struct SavedWind { // Wind::Moving
    double time;
    double way[3];
    float jump[3];
    uint32_t zero;
};
struct SavedWetness {
    double dried; // Wetness::dried()
};
struct SavedVolume {
    uint32_t nodes; // per edge of the grid whose pressure is carried
};
static_assert(sizeof(SavedSim) == 64 && sizeof(SavedRoots) == 244 && sizeof(Frame::State) == 184 &&
                  sizeof(SavedWind) == 48 && sizeof(SimLevels::Kept) == 40,
              "no padding: they are saved as bytes");

// Of a collider that is a mesh, in the order of their slots; then come the values of its nodes, and
// the clearance of every vertex.
struct SavedMesh {
    float origin[3], edge;
    uint32_t nodes[3];
    float band;
    ClearanceRules rules;
};

// The same of one of form NEAREST; then come its vertices as it was made, where they have been moved
// also where they were at the begin and are to be at the end of the call and of the last step, its
// triangles, the clearance, and of a sheet four numbers of every vertex, PLAIT_MESH_SIDE_....
struct SavedBendingMesh {
    uint32_t vertices, triangles, two_sided, posed;
    ClearanceRules rules;
};
static_assert(sizeof(SavedMesh) == 40 && sizeof(SavedBendingMesh) == 24);
static_assert(sizeof(Colliders::Slot) == sizeof(float) * (2 + 22 + 36),
              "no padding: slots are saved as bytes");

// All of a snapshot but colliders, settings and runs of floats.
struct Saved {
    SavedSim sim;
    SavedRoots roots;
    Frame::State frame;
    SavedWind wind;
    SavedWetness wetness;
    SavedVolume volume;
    SimLevels::Kept levels;
    std::array<bool, block_kinds> has{};

    bool is(BlockKind kind) const { return has[static_cast<size_t>(kind)]; }
};

// A run of floats that a snapshot holds.
struct Sim::Run {
    enum class Of {
        vertices,
        histories,
        poses,
        motion,
        turns,
        pushes,
        pressures,
        wetness
    };              // what its values may be
    BlockKind kind; // of which block
    const Buffer* buffer;
    size_t floats;
    Of of;
    LaneBuffer lanes;  // no buffer: saved as it lies
    bool taken = true; // by a sim that is restored, which may have no history
};

namespace snapshots {

constexpr uint32_t magic = 0x74696c70; // "plit"
constexpr uint32_t version = 1;

// "wetness".
const char* name_of(BlockKind kind);
SnapshotHead head();
BlockHead head_of(BlockKind kind, uint64_t bytes);

// BAD_DATA.
Error malformed(const std::string& what);
// `name[index]` is `value`, and that is outside of `range`.
Error outside(const char* name, size_t index, double value, const char* range);
uint64_t checksum_of(std::span<const unsigned char> bytes); // of a whole snapshot

// The bytes of every block, null where there is none.
using BlockBytes = std::array<std::span<const unsigned char>, block_kinds>;
// Before anything in it is believed. UNSUPPORTED: another version wrote it.
Result<BlockBytes> split(std::span<const unsigned char> bytes);
// Takes what Saved holds from the begin of each block, and checks it.
Result<Saved> take_saved(BlockBytes& blocks);

// saved_bodies.cpp: colliders, from the block of bodies, which each moves on; `vertices`: [guides][V].
Result<std::pmr::vector<Colliders::Slot>>
saved_slots(std::span<const unsigned char>& from, float scale, std::pmr::memory_resource* memory);
Result<Colliders::FacesOf> saved_faces(std::span<const Colliders::Slot> slots,
                                       std::span<const unsigned char>& from,
                                       std::pmr::memory_resource* memory);
Result<MeshColliders::Entries> saved_meshes(std::span<const Colliders::Slot> slots, size_t vertices,
                                            std::span<const unsigned char>& from,
                                            std::pmr::memory_resource* memory);
Result<BendingMeshes::Entries> saved_bending(std::span<const Colliders::Slot> slots,
                                             size_t vertices, std::span<const unsigned char>& from,
                                             std::pmr::memory_resource* memory);

// Its head from `from` on, which it moves on; false: that is too short.
template <typename Head> bool take(std::span<const unsigned char>& from, Head& to) {
    if (from.size() < sizeof to)
        return false;
    std::memcpy(&to, from.data(), sizeof to);
    from = from.subspan(sizeof to);
    return true;
}

// A place in the groom's units, of which each is `scale` metres.
Status check_pose(plait_pose pose, const char* name, float scale);

// Of a position (m) or a velocity (m/s): a head and a groom may be 1e6 m away each.
constexpr float largest = 4e6f;
// Of a run of floats.
float float_at(const unsigned char* bytes, size_t index);
// +-4e6 m, of which `scale` are one of the groom's units.
Status check_range(const unsigned char* bytes, size_t index, const char* name, float scale = 1);
// A quaternion of length 1, or of at most 1 where it is `blended`.
Status check_turn(const unsigned char* bytes, size_t first, const char* name, bool blended);

} // namespace snapshots
} // namespace plait
