// Gradient noise with a hash for each lattice point.
#pragma once

#include "backend/reference/base/math.hpp"

#include <array>
#include <cstdint>

namespace plait::reference {

// PCG-RXS-M-XS of 32 bits.
inline uint32_t hash_of(uint32_t value) {
    const uint32_t state = value * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

// The gradient at a lattice point: components in [-1, 1).
inline Vec3 noise_gradient(const std::array<uint32_t, 3>& point, uint32_t seed) {
    uint32_t hash = hash_of(seed);
    for (const int axis : {2, 1, 0})
        hash = hash_of(point[static_cast<size_t>(axis)] ^ hash);
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        hash = hash_of(hash);
        gradient[axis] = std::ldexp(double(hash >> 8), -23) - 1;
    }
    return gradient;
}

// Derivatives of the noise at `p` of a cell, [0, 1) in each.
inline Vec3 noise_derivatives(const std::array<uint32_t, 3>& cell, const Vec3& p, uint32_t seed) {
    const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
    const auto slope = [](double t) { return 30 * t * t * (1 - t) * (1 - t); };
    Vec3 sum = Vec3::Zero();
    for (uint32_t corner = 0; corner < 8; ++corner) {
        std::array<uint32_t, 3> point = cell;
        Vec3 from = p, weight, change;
        for (uint32_t axis = 0; axis < 3; ++axis) {
            const bool high = (corner >> axis & 1) != 0;
            point[axis] += high;
            from[axis] -= high;
            weight[axis] = high ? fade(p[axis]) : 1 - fade(p[axis]);
            change[axis] = high ? slope(p[axis]) : -slope(p[axis]);
        }
        const Vec3 gradient = noise_gradient(point, seed);
        sum += gradient * weight.prod();
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 factors = weight;
            factors[axis] = change[axis];
            sum[axis] += gradient.dot(from) * factors.prod();
        }
    }
    return sum;
}

} // namespace plait::reference
