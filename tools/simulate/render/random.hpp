// Numbers that depend on nothing but their indices, so that threads do not matter.
#pragma once

#include <cstdint>

namespace render {

// PCG output permutation as a hash (Jarzynski & Olano 2020).
inline uint32_t hash(uint32_t value) {
    const uint32_t state = value * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Uniform in [0, 1).
inline float uniform(uint32_t index, uint32_t stream) {
    return static_cast<float>(hash(index ^ hash(stream)) >> 8) * 0x1p-24f;
}

} // namespace render
