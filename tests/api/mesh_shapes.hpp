// Small meshes of known shape, for tests.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

struct ShapeMesh {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<uint32_t, 3>> triangles; // counter-clockwise from outside

    uint32_t add(double x, double y, double z) {
        positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
        return static_cast<uint32_t>(positions.size() - 1);
    }
    void add_quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
    void add_mesh(const ShapeMesh& other) {
        const auto first = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), other.positions.begin(), other.positions.end());
        for (const auto& t : other.triangles)
            triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    void turn_over() {
        for (auto& t : triangles)
            std::swap(t[1], t[2]);
    }
};

inline ShapeMesh box_mesh(double x, double y, double z) { // half its edges
    ShapeMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.add(i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z);
    mesh.add_quad(0, 2, 3, 1);
    mesh.add_quad(4, 5, 7, 6);
    mesh.add_quad(0, 1, 5, 4);
    mesh.add_quad(2, 6, 7, 3);
    mesh.add_quad(0, 4, 6, 2);
    mesh.add_quad(1, 3, 7, 5);
    return mesh;
}

// Rows of a grid that is closed around, u; `closed`: and along, v. at(u, v) with both in [0, 1).
template <typename At>
ShapeMesh revolved_mesh(uint32_t around, uint32_t along, bool closed, const At& at) {
    ShapeMesh mesh;
    const uint32_t rows = closed ? along : along + 1;
    for (uint32_t v = 0; v < rows; ++v)
        for (uint32_t u = 0; u < around; ++u) {
            const auto p = at(double(u) / around, double(v) / along);
            mesh.add(p[0], p[1], p[2]);
        }
    for (uint32_t v = 0; v < along; ++v)
        for (uint32_t u = 0; u < around; ++u) {
            const uint32_t next = (u + 1) % around, up = (v + 1) % rows;
            mesh.add_quad(v * around + u, v * around + next, up * around + next, up * around + u);
        }
    return mesh;
}

constexpr double full_turn = 6.283185307179586;

inline ShapeMesh torus_mesh(double radius, double tube, uint32_t around, uint32_t along) {
    return revolved_mesh(around, along, true, [=](double u, double v) {
        const double a = full_turn * u, b = full_turn * v;
        const double out = radius + tube * std::cos(a);
        return std::array<double, 3>{out * std::cos(b), tube * std::sin(a), out * std::sin(b)};
    });
}

// An ellipsoid about the origin of half axes x, y, z; 2 around (along - 1) triangles.
inline ShapeMesh ellipsoid_mesh(double x, double y, double z, uint32_t around, uint32_t along) {
    ShapeMesh mesh = revolved_mesh(around, along - 2, false, [=](double u, double v) {
        const double a = full_turn * u;
        const double b = full_turn / 2 * (1 + v * (along - 2)) / along;
        return std::array<double, 3>{x * std::sin(b) * std::cos(a), -y * std::cos(b),
                                     -z * std::sin(b) * std::sin(a)};
    });
    const uint32_t bottom = mesh.add(0, -y, 0), top = mesh.add(0, y, 0);
    const uint32_t last = around * (along - 2);
    for (uint32_t u = 0; u < around; ++u) {
        mesh.triangles.push_back({bottom, (u + 1) % around, u});
        mesh.triangles.push_back({top, last + u, last + (u + 1) % around});
    }
    return mesh;
}

// Half a torus whose ends are capped by fans.
inline ShapeMesh bent_tube_mesh(double radius, double tube, uint32_t around, uint32_t along) {
    ShapeMesh mesh = revolved_mesh(around, along, false, [=](double u, double v) {
        const double a = full_turn * u, b = full_turn / 2 * v;
        const double out = radius + tube * std::cos(a);
        return std::array<double, 3>{out * std::cos(b), tube * std::sin(a), out * std::sin(b)};
    });
    const uint32_t first = mesh.add(radius, 0, 0), second = mesh.add(-radius, 0, 0);
    for (uint32_t u = 0; u < around; ++u) {
        mesh.triangles.push_back({first, (u + 1) % around, u});
        mesh.triangles.push_back({second, along * around + u, along * around + (u + 1) % around});
    }
    return mesh;
}

// Two triangles in the plane y = 0, facing up.
inline ShapeMesh sheet_mesh(double half) {
    ShapeMesh mesh;
    const uint32_t a = mesh.add(-half, 0, -half), b = mesh.add(-half, 0, half),
                   c = mesh.add(half, 0, half), d = mesh.add(half, 0, -half);
    mesh.add_quad(a, b, c, d);
    return mesh;
}
