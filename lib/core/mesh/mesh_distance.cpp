#include "core/mesh/mesh_distance.hpp"

#include "core/mesh/mesh_edges.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace plait {
// Where in a triangle the nearest point is: face, an edge, or a corner.
struct TrianglePlace {
    Eigen::Vector3d point;
    int edge = -1, corner = -1;
};

namespace {

using Vec3 = Eigen::Vector3d;

constexpr uint32_t node_triangles = 4;
constexpr size_t deepest = 64; // nodes on the way down; halves of 2^32 triangles take 32

Vec3 unit(const Vec3& v) {
    const double length = v.norm();
    return length > 0 ? Vec3(v / length) : Vec3::Zero();
}

double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

TrianglePlace on_edge(int edge, const Vec3& from, const Vec3& to, double share) {
    return {from + share * (to - from), edge, -1};
}

// By the regions outside of it that its corners and edges own.
TrianglePlace place_in(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
    const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
    const double d1 = ab.dot(ax), d2 = ac.dot(ax);
    if (d1 <= 0 && d2 <= 0)
        return {a, -1, 0};
    const double d3 = ab.dot(bx), d4 = ac.dot(bx);
    if (d3 >= 0 && d4 <= d3)
        return {b, -1, 1};
    const double over_ab = d1 * d4 - d3 * d2;
    if (over_ab <= 0 && d1 >= 0 && d3 <= 0)
        return on_edge(0, a, b, d1 / (d1 - d3));
    const double d5 = ab.dot(cx), d6 = ac.dot(cx);
    if (d6 >= 0 && d5 <= d6)
        return {c, -1, 2};
    const double over_ca = d5 * d2 - d1 * d6;
    if (over_ca <= 0 && d2 >= 0 && d6 <= 0)
        return on_edge(2, a, c, d2 / (d2 - d6));
    const double over_bc = d3 * d6 - d5 * d4;
    if (over_bc <= 0 && d4 >= d3 && d5 >= d6)
        return on_edge(1, b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = over_ab + over_bc + over_ca;
    return {a + ab * (over_ca / sum) + ac * (over_ab / sum), -1, -1};
}

double squared_to_box(const Vec3& low, const Vec3& high, const Vec3& x) {
    return (low - x).cwiseMax(x - high).cwiseMax(0.0).squaredNorm();
}

} // namespace

struct MeshDistance::Found {
    double squared = std::numeric_limits<double>::infinity();
    uint32_t triangle = 0;
    TrianglePlace place{};
};

Vec3 MeshDistance::corner(uint32_t triangle, size_t k) const {
    const MeshPoint& p = surface_.positions[surface_.triangles[triangle][k]];
    return {double(p[0]), double(p[1]), double(p[2])};
}

const MeshDistance::Features MeshDistance::no_features{Vec3::Zero(),
                                                       {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};

MeshDistance::MeshDistance(const TriangleSet& surface, std::pmr::memory_resource* memory)
    : surface_(surface), nodes_(memory), order_(surface.triangles.size(), 0u, memory),
      features_(surface.triangles.size(), no_features, memory),
      corners_(surface.positions.size(), Vec3(Vec3::Zero()), memory) {
    const auto number = static_cast<uint32_t>(surface.triangles.size());
    for (uint32_t t = 0; t < number; ++t) {
        const Vec3 a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
        features_[t].face = unit((b - a).cross(c - a));
        const Vec3 sides[3] = {b - a, c - b, a - c};
        for (size_t k = 0; k < 3; ++k)
            corners_[surface.triangles[t][k]] +=
                angle_between(sides[k], -sides[(k + 2) % 3]) * features_[t].face;
    }
    for (Vec3& normal : corners_)
        normal = unit(normal);
    const MeshEdges edges(surface.triangles, memory);
    for (size_t e = 0; e < edges.count(); ++e) {
        Vec3 sum = Vec3::Zero();
        for (const MeshEdges::Side& side : edges.edge(e))
            sum += features_[side.triangle].face;
        for (const MeshEdges::Side& side : edges.edge(e))
            features_[side.triangle].edge[side.corner] = unit(sum);
    }
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, number);
}

void MeshDistance::measure(Node& node, uint32_t first, uint32_t last) const {
    node.low = Vec3::Constant(std::numeric_limits<double>::infinity());
    node.high = -node.low;
    for (uint32_t i = first; i < last; ++i)
        for (size_t k = 0; k < 3; ++k) {
            node.low = node.low.cwiseMin(corner(order_[i], k));
            node.high = node.high.cwiseMax(corner(order_[i], k));
        }
}

// Halves by the middles of triangles along the longest side.
uint32_t MeshDistance::build(uint32_t first, uint32_t last) {
    const auto index = static_cast<uint32_t>(nodes_.size());
    nodes_.emplace_back();
    measure(nodes_[index], first, last);
    nodes_[index].first = first;
    nodes_[index].number = last - first;
    if (last - first <= node_triangles)
        return index;
    Eigen::Index axis = 0;
    (nodes_[index].high - nodes_[index].low).maxCoeff(&axis);
    const auto middle_of = [&](uint32_t t) {
        return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
    };
    const uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](uint32_t a, uint32_t b) {
                         const double at_a = middle_of(a), at_b = middle_of(b);
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    build(first, middle);
    const uint32_t second = build(middle, last);
    nodes_[index].first = second;
    nodes_[index].number = 0;
    return index;
}

void MeshDistance::try_triangle(uint32_t triangle, const Vec3& x, Found& found) const {
    const TrianglePlace place =
        place_in(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2), x);
    const double squared = (x - place.point).squaredNorm();
    if (squared < found.squared)
        found = {squared, triangle, place};
}

// Nearer boxes first; those farther than what is found are left out.
void MeshDistance::search(const Vec3& x, Found& found) const {
    struct Left {
        uint32_t node;
        double squared;
    };
    std::array<Left, deepest> stack;
    size_t depth = 0;
    stack[depth++] = {0, squared_to_box(nodes_[0].low, nodes_[0].high, x)};
    while (depth > 0) {
        const Left left = stack[--depth];
        if (left.squared >= found.squared)
            continue;
        const Node& node = nodes_[left.node];
        if (node.number > 0) {
            for (uint32_t i = 0; i < node.number; ++i)
                try_triangle(order_[node.first + i], x, found);
            continue;
        }
        const uint32_t children[2] = {left.node + 1, node.first};
        const double squared[2] = {
            squared_to_box(nodes_[children[0]].low, nodes_[children[0]].high, x),
            squared_to_box(nodes_[children[1]].low, nodes_[children[1]].high, x)};
        const size_t far = squared[1] >= squared[0];
        stack[depth++] = {children[far], squared[far]};
        stack[depth++] = {children[1 - far], squared[1 - far]};
    }
}

MeshNearest MeshDistance::nearest(const Vec3& x, uint32_t hint) const {
    Found found;
    try_triangle(hint, x, found);
    search(x, found);
    const Features& features = features_[found.triangle];
    MeshNearest nearest;
    nearest.triangle = found.triangle;
    nearest.point = found.place.point;
    nearest.distance = std::sqrt(found.squared);
    if (found.place.corner >= 0)
        nearest.outward =
            corners_[surface_.triangles[found.triangle][static_cast<size_t>(found.place.corner)]];
    else if (found.place.edge >= 0)
        nearest.outward = features.edge[static_cast<size_t>(found.place.edge)];
    else
        nearest.outward = features.face;
    nearest.inside = nearest.outward.dot(x - nearest.point) < 0;
    return nearest;
}

} // namespace plait
