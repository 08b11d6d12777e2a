// What a snapshot looks like, and what of it can be told without a sim.
#pragma once

#include "core/sim/sim.hpp"

#include <span>

namespace plait {

// Of a strand, as Settings has it.
struct SavedSettings {
    uint32_t model, substeps, iterations, bdf2;
};

// Of a collider that is a mesh, in the order of their slots; then come the values of its nodes, and
// the clearance of every vertex.
struct SavedMesh {
    float origin[3], edge;
    uint32_t nodes[3];
    float band;
};

// The same of one of form NEAREST; then come its vertices as it was made, where they have been moved
// also where they were at the begin and are to be at the end of the call and of the last step, its
// triangles, the clearance, and of a sheet four numbers of every vertex, PLAIT_MESH_SIDE_....
struct SavedBendingMesh {
    uint32_t vertices, triangles, two_sided, posed;
};

struct SnapshotHeader {
    uint32_t magic;
    uint32_t version;
    uint64_t checksum; // of every byte after it
    uint64_t groom;    // its fingerprint
    uint32_t model;
    uint32_t guides;
    uint32_t row;
    uint32_t substeps;
    float step;
    uint32_t colliders; // slots, dead ones included
    double waiting;
    uint64_t steps;
    uint64_t dropped;
    plait_pose heads[5]; // at, target, from, to, before
    uint32_t own[5];
    uint32_t aimed;
    uint32_t kept;
    uint32_t switched; // 1: strands have settings of their own
    uint32_t pins;     // 1: they are there
    double wind_time;  // Wind::Moving
    double wind_way[3];
    float wind_jump[3];
    uint32_t volume; // nodes per edge of the grid whose pressure is carried; 0: none
    double dried;    // Wetness::dried()
    uint32_t wet;    // 1: strands may be
    uint32_t bends;  // Roots::samples()
    uint32_t motion; // Sim::Motion
    uint32_t told, waited;
    uint32_t first_aim;
    Frame::State frame;
    plait_pose placed[2]; // Sim::placed_from_, placed_to_
    float scale;          // Sim::scale_
};
static_assert(sizeof(SnapshotHeader) == 72 + 140 + 36 + 48 + 16 + 16 + 156 + 56 + 4);
static_assert(sizeof(Colliders::Slot) == sizeof(float) * (2 + 22 + 36),
              "no padding: slots are saved as bytes");

namespace snapshots {

constexpr uint32_t magic = 0x74696c70; // "plit"
constexpr uint32_t version = 11;

// BAD_DATA.
Error malformed(const std::string& what);
// `name[index]` is `value`, and that is outside of `range`.
Error outside(const char* name, size_t index, double value, const char* range);
uint64_t checksum_of(std::span<const unsigned char> bytes);

// What can be told before anything in it is believed.
Status check_whole(const SnapshotHeader& h, std::span<const unsigned char> bytes);
Status check_header(const SnapshotHeader& h);
// Colliders, as a snapshot holds them from `from` on.
Result<std::pmr::vector<Colliders::Slot>>
saved_slots(const SnapshotHeader& h, const unsigned char* from, std::pmr::memory_resource* memory);
// The faces of those of them that are hulls, and those that are meshes, by form, from `from` on, which
// each moves on; `vertices`: [guides][V].
Result<Colliders::FacesOf> saved_faces(std::span<const Colliders::Slot> slots,
                                       std::span<const unsigned char>& from,
                                       std::pmr::memory_resource* memory);
Result<MeshColliders::Entries> saved_meshes(std::span<const Colliders::Slot> slots, size_t vertices,
                                            std::span<const unsigned char>& from,
                                            std::pmr::memory_resource* memory);
Result<BendingMeshes::Entries> saved_bending(std::span<const Colliders::Slot> slots,
                                             size_t vertices, std::span<const unsigned char>& from,
                                             std::pmr::memory_resource* memory);

// Of a run of floats.
float float_at(const unsigned char* bytes, size_t index);
// +-4e6 m, of which `scale` are one of the groom's units.
Status check_range(const unsigned char* bytes, size_t index, const char* name, float scale = 1);
// A quaternion of length 1, or of at most 1 where it is `blended`.
Status check_turn(const unsigned char* bytes, size_t first, const char* name, bool blended);

} // namespace snapshots
} // namespace plait
