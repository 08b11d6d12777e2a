// One strand at rest: a helix of any curvature and torsion (none: straight), or given points.
#pragma once

#include "common.hpp"

#include <optional>
#include <vector>

namespace lab {

enum class Aim { tangent, axis, segment };

struct Strand {
    uint32_t segments = 16;            // [1, 255]
    double length = 0.3;               // m
    Vec3 root = Vec3::Zero();          // m
    Vec3 direction = Vec3::UnitX();    // unit; of the curve where it begins,
    Aim aim = Aim::tangent;            // or of the helix's axis, or of the first segment
    double roll = 0;                   // degrees about `direction`
    Vec3 towards = Vec3::Zero();       // where the first curve bends; zero: wherever
    double curvature = 0, torsion = 0; // of the rest shape, 1/m; torsion > 0 is right-handed
    double segment_ratio = 1;          // last segment : first, in geometric progression
    uint32_t mode = 0;                 // 1..: bent into this mode of the hanging limp chain,
    double amplitude = 0.01;           // whose tip is so many lengths aside
    std::vector<Vec3> points;          // the shape itself, m; then segments and length are its own
    std::optional<double> gamma;       // rho A g L^3 / EI of its own, else the material's EI

    std::vector<double> segment_lengths() const;
};

// Vertices at rest. `pinned` and `half_tip` say whose modes the strand bends into.
std::vector<Vec3> rest_shape(const Strand& strand, uint32_t pinned, bool half_tip);

} // namespace lab
