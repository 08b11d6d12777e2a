// Triangle meshes that hair collides with, checked and mended: every corner exists, no triangle is
// without area or there twice, and where the surface is closed all triangles face outward.
#pragma once

#include "base/result.hpp"
#include "core/mesh/mesh_skin.hpp"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <vector>

namespace plait {

using Triangle = std::array<uint32_t, 3>;
using MeshPoint = std::array<float, 3>;

struct TriangleSet {
    explicit TriangleSet(std::pmr::memory_resource* memory)
        : positions(memory), triangles(memory) {}
    bool operator==(const TriangleSet&) const = default;

    std::pmr::vector<MeshPoint> positions; // m
    std::pmr::vector<Triangle> triangles;  // counter-clockwise, seen from outside
};

// As a file or caller gives it: nothing checked yet beyond array sizes.
struct RawMesh {
    explicit RawMesh(std::pmr::memory_resource* memory) : surface(memory), skin(memory) {}

    TriangleSet surface;
    MeshSkin skin;
    uint64_t skins_reduced = 0; // vertices whose bones had to be chosen
    std::string first_reduced;  // the first of them
};

struct MeshRepairs {
    std::array<uint64_t, PLAIT_MESH_REPAIR_COUNT> count{};
    std::string first; // the first offender

    uint64_t total() const;
};

struct MeshShape {
    uint64_t open_edges = 0;    // of one triangle
    uint64_t unsided_edges = 0; // of more than two, or between triangles that disagree on sides
    std::array<uint32_t, 2> first_open{}, first_unsided{}; // vertices of the first of each
    uint32_t components = 0;
    MeshPoint bounds_min{}, bounds_max{};
    double volume = 0; // m^3, of what is closed
    double area = 0;   // m^2
};

// Immutable once made, so threads and contexts may share it.
struct Mesh {
    explicit Mesh(std::pmr::memory_resource* memory)
        : surface(memory), skin(memory), sources(memory) {}

    TriangleSet surface;
    MeshSkin skin;
    std::pmr::vector<uint32_t> sources; // of each vertex, which it was
    MeshShape shape;
    MeshRepairs repairs;
};

// Mends `raw` by the rules. BAD_DATA: an index, a coordinate or a weight out of range, nothing left,
// or policy REFUSE. `where`: in front of messages, "" or "head.obj: ". `mesh` keeps its memory.
Status build_mesh(const RawMesh& raw, plait_repair_policy policy, const std::string& where,
                  Mesh& mesh);

} // namespace plait
