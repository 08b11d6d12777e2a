// What the stories share: straight hairs of 0.3 m, and time.
#pragma once

#include <plait/plait.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace story {

using Point = std::array<float, 3>;

constexpr std::uint32_t vertices = 16;
constexpr float length = 0.3f; // m
constexpr std::uint32_t tip = vertices - 1;
constexpr Point level{1, 0, 0}, down{0, -1, 0};

// Hairs that leave their roots along `direction`, a unit vector.
inline plait::Groom hairs(const std::vector<Point>& roots, const Point& direction) {
    std::vector<float> positions;
    for (const Point& root : roots)
        for (std::uint32_t i = 0; i < vertices; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis)
                positions.push_back(root[axis] + direction[axis] * length * float(i) / float(tip));
    auto desc = plait_groom_desc_defaults();
    desc.positions = plait::view(positions, 3);
    desc.vertices_per_strand = vertices;
    return plait::Groom(desc);
}

inline plait::Groom hair(const Point& direction) {
    return hairs({{0, 0, 0}}, direction);
}

inline void pass(plait::Sim& sim, double seconds) {
    for (int frame = 0; frame < std::lround(60 * seconds); ++frame)
        sim.step(1.0 / 60);
}

inline Point vertex(const plait::Sim& sim, std::uint32_t strand, std::uint32_t i) {
    const auto x = sim.read(PLAIT_FIELD_POSITION); // float4 each
    const float* at = &x[4 * (strand * vertices + i)];
    return {at[0], at[1], at[2]};
}
inline Point tip_of(const plait::Sim& sim, std::uint32_t strand = 0) {
    return vertex(sim, strand, tip);
}

inline float distance(const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

inline plait_roots head_at(const Point& place) {
    auto roots = plait_roots_defaults();
    for (std::size_t axis = 0; axis < 3; ++axis)
        roots.head.t[axis] = place[axis];
    return roots;
}

} // namespace story
