#include "core/mesh/mesh_edges.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace plait {
namespace {

using Vec3 = Eigen::Vector3d;

Vec3 vector_of(const MeshPoint& p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}

// Triangles that hang together by edges.
struct Component {
    std::pmr::vector<uint32_t> triangles;
    bool closed = true; // every edge has two sides
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double volume = 0; // m^3

    explicit Component(std::pmr::memory_resource* memory) : triangles(memory) {}
};

// Of the tetrahedron that a triangle spans with `origin`, six times.
double spanned(const TriangleSet& surface, const Triangle& t, const Vec3& origin) {
    const Vec3 a = vector_of(surface.positions[t[0]]) - origin;
    const Vec3 b = vector_of(surface.positions[t[1]]) - origin;
    const Vec3 c = vector_of(surface.positions[t[2]]) - origin;
    return a.dot(b.cross(c));
}

// Walks over edges of two sides from one triangle to all that hang with it; `turned` becomes
// whether each has to be turned over to agree with the first.
void spread(const MeshEdges& edges, uint32_t first, std::pmr::vector<uint8_t>& reached,
            std::pmr::vector<uint8_t>& turned, Component& to) {
    to.triangles.push_back(first);
    reached[first] = 1;
    for (size_t k = 0; k < to.triangles.size(); ++k) {
        const uint32_t here = to.triangles[k];
        for (size_t corner = 0; corner < 3; ++corner) {
            const auto sides = edges.edge(edges.edge_of(here, corner));
            to.closed = to.closed && sides.size() == 2;
            if (sides.size() != 2)
                continue;
            const uint32_t other = sides[sides[0].triangle == here].triangle;
            if (reached[other])
                continue;
            reached[other] = 1;
            turned[other] =
                static_cast<uint8_t>(turned[here] ^ (sides[0].forward == sides[1].forward));
            to.triangles.push_back(other);
        }
    }
}

std::pmr::vector<Component> components_of(const MeshEdges& edges, const TriangleSet& surface,
                                          std::pmr::vector<uint8_t>& turned,
                                          std::pmr::memory_resource* memory) {
    const size_t number = surface.triangles.size();
    std::pmr::vector<uint8_t> reached(number, uint8_t{0}, memory);
    std::pmr::vector<Component> all(memory);
    for (uint32_t t = 0; t < number; ++t)
        if (!reached[t])
            spread(edges, t, reached, turned, all.emplace_back(memory));
    for (Component& component : all) {
        for (const uint32_t t : component.triangles)
            for (const uint32_t corner : surface.triangles[t]) {
                component.low = component.low.cwiseMin(vector_of(surface.positions[corner]));
                component.high = component.high.cwiseMax(vector_of(surface.positions[corner]));
            }
        for (const uint32_t t : component.triangles)
            component.volume += (turned[t] ? -1.0 : 1.0) / 6 *
                                spanned(surface, surface.triangles[t], component.low);
    }
    return all;
}

bool lies_in(const Component& inner, const Component& outer) {
    return (inner.low.array() >= outer.low.array()).all() &&
           (inner.high.array() <= outer.high.array()).all();
}

// Turned as a whole: what is open as most of its triangles were, what is closed to face outward. A
// closed one within another may be a hollow, which faces inward, and stays.
bool turns_whole(const Component& component, std::span<const Component> all,
                 std::span<const uint8_t> turned) {
    const auto many =
        std::ranges::count_if(component.triangles, [&](uint32_t t) { return turned[t] != 0; });
    const bool most = 2 * static_cast<size_t>(many) > component.triangles.size();
    if (!component.closed)
        return most;
    const bool inner = std::ranges::any_of(all, [&](const Component& other) {
        return &other != &component && lies_in(component, other);
    });
    return inner ? most : component.volume < 0;
}

} // namespace

MeshEdges::MeshEdges(std::span<const Triangle> triangles, std::pmr::memory_resource* memory)
    : sides_(memory), first_(memory), edge_(3 * triangles.size(), 0u, memory) {
    sides_.reserve(3 * triangles.size());
    for (uint32_t t = 0; t < triangles.size(); ++t)
        for (uint8_t corner = 0; corner < 3; ++corner) {
            const uint32_t from = triangles[t][corner], to = triangles[t][(corner + 1u) % 3];
            sides_.push_back({std::min(from, to), std::max(from, to), t, corner, from < to});
        }
    std::ranges::sort(sides_, [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (uint32_t i = 0; i < sides_.size(); ++i) {
        if (i == 0 || sides_[i].low != sides_[i - 1].low || sides_[i].high != sides_[i - 1].high)
            first_.push_back(i);
        edge_[size_t{3} * sides_[i].triangle + sides_[i].corner] =
            static_cast<uint32_t>(first_.size() - 1);
    }
    first_.push_back(static_cast<uint32_t>(sides_.size()));
}

// Corners a, b, c become a, c, b: the sides ab, bc, ca become those of corners 2, 1, 0.
void MeshEdges::turn_over(std::span<const uint8_t> turned) {
    for (Side& side : sides_)
        if (turned[side.triangle]) {
            side.forward = !side.forward;
            side.corner = static_cast<uint8_t>(2 - side.corner);
        }
    for (size_t t = 0; t < turned.size(); ++t)
        if (turned[t])
            std::swap(edge_[3 * t], edge_[3 * t + 2]);
}

std::pmr::vector<Triangle> turn_outward(MeshEdges& edges, TriangleSet& surface,
                                        std::pmr::memory_resource* memory) {
    std::pmr::vector<uint8_t> turned(surface.triangles.size(), uint8_t{0}, memory);
    const auto components = components_of(edges, surface, turned, memory);
    std::pmr::vector<Triangle> list(memory);
    for (const Component& component : components)
        if (turns_whole(component, components, turned))
            for (const uint32_t t : component.triangles)
                turned[t] ^= 1;
    for (size_t t = 0; t < turned.size(); ++t)
        if (turned[t]) {
            list.push_back(surface.triangles[t]);
            std::swap(surface.triangles[t][1], surface.triangles[t][2]);
        }
    edges.turn_over(turned);
    return list;
}

void measure_mesh(const MeshEdges& edges, Mesh& mesh) {
    MeshShape& shape = mesh.shape;
    const TriangleSet& surface = mesh.surface;
    for (size_t e = 0; e < edges.count(); ++e) {
        const auto sides = edges.edge(e);
        const std::array<uint32_t, 2> ends{sides[0].low, sides[0].high};
        if (sides.size() == 1) {
            if (shape.open_edges++ == 0)
                shape.first_open = ends;
        } else if (!MeshEdges::agree(sides) && shape.unsided_edges++ == 0) {
            shape.first_unsided = ends;
        }
    }
    std::pmr::memory_resource* const memory = surface.positions.get_allocator().resource();
    std::pmr::vector<uint8_t> turned(surface.triangles.size(), uint8_t{0}, memory);
    const auto components = components_of(edges, surface, turned, memory);
    shape.components = static_cast<uint32_t>(components.size());
    Vec3 low = components.front().low, high = components.front().high;
    for (const Component& component : components) {
        low = low.cwiseMin(component.low);
        high = high.cwiseMax(component.high);
        shape.volume += component.closed ? component.volume : 0;
    }
    for (size_t k = 0; k < 3; ++k) {
        shape.bounds_min[k] = static_cast<float>(low[static_cast<int>(k)]);
        shape.bounds_max[k] = static_cast<float>(high[static_cast<int>(k)]);
    }
    for (const Triangle& t : surface.triangles) {
        const Vec3 a = vector_of(surface.positions[t[0]]);
        const Vec3 ab = vector_of(surface.positions[t[1]]) - a,
                   ac = vector_of(surface.positions[t[2]]) - a;
        shape.area += 0.5 * ab.cross(ac).norm();
    }
}

} // namespace plait
