// Random numbers by counter: the value depends only on (seed, stream, index), never on the order of
// calls or on a standard library's distributions.
#pragma once

#include <cstdint>

namespace plait_generator {

// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014).
inline uint64_t scramble(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Uniform in [0, 1), 53 bits.
inline double random(uint64_t seed, uint64_t stream, uint64_t index) {
    const uint64_t bits = scramble(scramble(scramble(seed) ^ stream) ^ index);
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

// Uniform in [-1, 1).
inline double random_signed(uint64_t seed, uint64_t stream, uint64_t index) {
    return 2 * random(seed, stream, index) - 1;
}

} // namespace plait_generator
