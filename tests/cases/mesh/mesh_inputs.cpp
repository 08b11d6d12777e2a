#include "mesh/mesh_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plait::cases {
namespace {

void add_neighbours(std::vector<uint32_t>& triangle, const MeshCorners& corners) {
    for (const auto& t : corners) {
        triangle.insert(triangle.end(), t.begin(), t.end());
        for (size_t k = 0; k < 3; ++k) {
            uint32_t across = PLAIT_MESH_NO_TRIANGLE;
            for (uint32_t other = 0; other < corners.size(); ++other)
                for (size_t j = 0; j < 3; ++j)
                    if (corners[other][j] == t[(k + 1) % 3] && corners[other][(j + 1) % 3] == t[k])
                        across = other;
            triangle.push_back(across);
        }
    }
}

void add_rings(std::vector<uint32_t>& ring, const MeshCorners& corners, uint32_t vertices) {
    std::vector<uint32_t> first, list;
    for (uint32_t v = 0; v < vertices; ++v) {
        first.push_back(static_cast<uint32_t>(vertices + 1 + list.size()));
        for (uint32_t t = 0; t < corners.size(); ++t)
            if (std::ranges::count(corners[t], v) > 0)
                list.push_back(t);
    }
    first.push_back(static_cast<uint32_t>(vertices + 1 + list.size()));
    ring.insert(ring.end(), first.begin(), first.end());
    ring.insert(ring.end(), list.begin(), list.end());
}

// Halves in the order they have, whose boxes overlap: a tree is right whatever its boxes are.
void add_node(NearestMeshes& meshes, const MeshCorners& corners, size_t first_vertex, uint32_t root,
              uint32_t begin, uint32_t end) {
    const size_t at = meshes.tree.size();
    meshes.tree.insert(meshes.tree.end(), {begin, end - begin});
    std::array<float, 8> box{};
    std::fill_n(box.begin(), 3, 1e9f);
    std::fill_n(box.begin() + 4, 3, -1e9f);
    for (uint32_t t = begin; t < end; ++t)
        for (const uint32_t corner : corners[t])
            for (const auto* points : {&meshes.from, &meshes.to})
                for (size_t k = 0; k < 3; ++k) {
                    const float c = (*points)[4 * (first_vertex + corner) + k];
                    box[k] = std::min(box[k], c - 1e-7f);
                    box[k + 4] = std::max(box[k + 4], c + 1e-7f);
                }
    meshes.box.insert(meshes.box.end(), box.begin(), box.end());
    if (end - begin <= 5)
        return;
    const uint32_t middle = (begin + end) / 2;
    add_node(meshes, corners, first_vertex, root, begin, middle);
    meshes.tree[at] = static_cast<uint32_t>(meshes.tree.size() / 2) - root;
    meshes.tree[at + 1] = 0;
    add_node(meshes, corners, first_vertex, root, middle, end);
}

} // namespace

void append_floats(std::vector<float>& to, std::initializer_list<double> values) {
    for (const double value : values)
        to.push_back(static_cast<float>(value));
}

void NearestMeshes::add(const MeshCorners& corners, const std::vector<Point>& from_where,
                        const std::vector<Point>& to_where, bool sheet) {
    const auto vertices = static_cast<uint32_t>(from.size() / 4),
               node = static_cast<uint32_t>(tree.size() / 2);
    first.insert(first.end(),
                 {node, static_cast<uint32_t>(triangle.size() / PLAIT_MESH_TRIANGLE_STRIDE),
                  vertices, static_cast<uint32_t>(ring.size()), sheet ? 1u : 0u,
                  static_cast<uint32_t>(corners.size())});
    double most = 0;
    for (size_t i = 0; i < from_where.size(); ++i) {
        const Point &a = from_where[i], &b = to_where[i];
        append_floats(from, {a[0], a[1], a[2], 0});
        append_floats(to, {b[0], b[1], b[2], 0});
        most = std::max(most, std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
    }
    append_floats(bends, {1.01 * most});
    add_neighbours(triangle, corners);
    add_rings(ring, corners, static_cast<uint32_t>(from_where.size()));
    add_node(*this, corners, vertices, node, 0, static_cast<uint32_t>(corners.size()));
}

std::vector<Array> NearestMeshes::buffers() const {
    return {uints(first),  float4s(box), uints(tree),   uints(triangle),  uints(ring),
            float4s(from), float4s(to),  floats(bends), floats(clearance)};
}

namespace {

constexpr uint32_t around = 9, rings = 7; // vertices of a ball, without its poles

// Of a ball: quads between rings, fans around the poles; without the upper fan it is open.
MeshCorners triangles_of_ball(bool open) {
    MeshCorners list;
    for (uint32_t v = 0; v + 1 < rings; ++v)
        for (uint32_t u = 0; u < around; ++u) {
            const uint32_t next = (u + 1) % around;
            const uint32_t a = v * around + u, b = v * around + next, up = around;
            list.push_back({a, b, b + up});
            list.push_back({a, b + up, a + up});
        }
    const uint32_t last = (rings - 1) * around, bottom = rings * around, top = bottom + 1;
    for (uint32_t u = 0; u < around; ++u) {
        list.push_back({bottom, (u + 1) % around, u});
        if (!open)
            list.push_back({top, last + u, last + (u + 1) % around});
    }
    return list;
}

Point place_in_ball(uint32_t vertex, double radius) {
    constexpr double pi = std::numbers::pi;
    if (vertex >= rings * around)
        return {0, vertex > rings * around ? radius : -radius, 0};
    const double a = 2 * pi * (vertex % around) / around,
                 b = pi * (vertex / around + 1.0) / (rings + 1.0);
    return {radius * std::sin(b) * std::cos(a), -radius * std::cos(b),
            -radius * std::sin(b) * std::sin(a)};
}

} // namespace

void add_ball(NearestMeshes& meshes, Random& random, bool sheet, bool bends) {
    const double radius = random.uniform(0.03, 0.05), bulge = random.uniform(0.002, 0.004);
    std::vector<Point> from, to;
    for (uint32_t i = 0; i < rings * around + 2; ++i) {
        Point p = place_in_ball(i, radius);
        for (double& c : p)
            c *= 1 + bulge / radius * std::sin(30 * p[0]) * std::cos(40 * p[1]);
        from.push_back(p);
        if (bends)
            p = {p[0] + 0.004 * std::sin(40 * p[1]), p[1] + 0.003 * std::cos(50 * p[2]),
                 p[2] + 0.005 * std::sin(45 * p[0])};
        to.push_back(p);
    }
    meshes.add(triangles_of_ball(sheet), from, to, sheet);
}

void add_mesh_row(std::vector<float>& rows, Random& random, const LaneHair& lanes, size_t vertex,
                  double gap, std::array<double, 2> shares) {
    const size_t stride = lanes.hair.size.stride;
    const float* root = &lanes.x[3 * (vertex / stride) * stride];
    const float* x = &lanes.x[3 * vertex];
    const Point aside = random.direction();
    Point begin{}, end{};
    const double down[3] = {0.37, -0.74, 0.56}, off = 0.04 + gap;
    for (size_t k = 0; k < 3; ++k) {
        begin[k] = double(root[k]) + double(x[k]) + off * (down[k] + 0.2 * aside[k]);
        end[k] = begin[k] + random.uniform(-0.01, 0.01);
    }
    const auto orientation = random.rotation();
    const auto axis = random.direction();
    const double half = random.uniform(0.03, 0.08);
    append_floats(rows, {begin[0], begin[1], begin[2], shares[0]});
    append_floats(rows, {orientation[0], orientation[1], orientation[2], orientation[3]});
    append_floats(rows, {end[0], end[1], end[2], shares[1]});
    append_floats(rows, {0, 0, 0, 0});
    append_floats(rows, {axis[0] * std::sin(half), axis[1] * std::sin(half),
                         axis[2] * std::sin(half), std::cos(half)});
    append_floats(rows, {random.uniform(0.2, 0.9), double{PLAIT_KIND_MESH}, 0, 0});
}

void pin_tips(Setup& setup, size_t first) {
    auto params = setup.params_as<plait_lane_params>();
    params.pins = 1;
    setup.name += ", pinned";
    std::vector<float>& pins = setup.buffers[first].floats;
    const std::vector<float>& x = setup.buffers[first + 1].floats;
    const std::vector<float>& material = setup.buffers[3].floats;
    for (size_t row = 0; row < pins.size() / 4; ++row) {
        for (size_t k = 0; k < 3; ++k)
            pins[4 * row + k] = x[3 * row + k] + 0.01f;
        pins[4 * row + 3] = 3 * material[PLAIT_LANE_MATERIAL_COMPONENTS * row + PLAIT_LANE_MASS] /
                            (params.h * params.h);
    }
    setup.with(params);
}

Setup reordered_too(Setup setup, std::initializer_list<size_t> rows) {
    const Setup plain = setup;
    setup = reordered(std::move(setup));
    for (const size_t buffer : rows) {
        const std::vector<float>& from = plain.buffers[buffer].floats;
        const size_t width = from.size() / setup.items;
        for (size_t lane = 0; lane < setup.items; ++lane)
            std::copy_n(&from[lane * width], width,
                        &setup.buffers[buffer].floats[setup.buffers[0].words[lane] * width]);
    }
    return setup;
}

} // namespace plait::cases
