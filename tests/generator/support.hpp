// What the tests of the generator share.
#pragma once

#include "generator/generator.hpp"
#include "generator/head_shape.hpp"
#include "generator/vec.hpp"

#include <array>
#include <vector>

namespace plait_generator {

// On the mannequin.
inline constexpr std::array all_hairstyles{
    Hairstyle::Long, Hairstyle::Braid, Hairstyle::Curly,      Hairstyle::Short, Hairstyle::Ponytail,
    Hairstyle::Bob,  Hairstyle::Afro,  Hairstyle::Dreadlocks, Hairstyle::Beard};

inline Strands sample_groom(Hairstyle hairstyle, uint32_t strands = 400) {
    Style style = make_style(hairstyle);
    style.strands = strands;
    return make_groom(style);
}

inline Vec3 point(const std::vector<float>& xyz, size_t i) {
    return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
}

// Strand i of a groom whose strands all have as many vertices as the first.
inline std::vector<Vec3> strand(const Strands& strands, size_t i) {
    const size_t vertices = strands.vertex_counts[0];
    std::vector<Vec3> points;
    for (size_t k = 0; k < vertices; ++k)
        points.push_back(point(strands.positions, i * vertices + k));
    return points;
}

// Distance to a capsule: the union of the spheres along its axis.
inline double capsule_distance(const Capsule& c, Vec3 p) {
    const Vec3 a{c.a[0], c.a[1], c.a[2]}, b{c.b[0], c.b[1], c.b[2]};
    double nearest = 1e9;
    for (int i = 0; i <= 32; ++i) {
        const double t = i / 32.0;
        nearest = std::min(nearest, length(p - mix(a, b, t)) -
                                        mix(double{c.radius_a}, double{c.radius_b}, t));
    }
    return nearest;
}

} // namespace plait_generator
