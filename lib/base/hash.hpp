// 64-bit hashes and counter-based random numbers: pure functions of their inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace plait {

// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection that mixes every bit into every.
inline uint64_t mix64(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

// Uniform in [-1, 1), the same for the same (seed, counter) everywhere.
inline float uniform_signed(uint64_t seed, uint64_t counter) {
    const uint64_t bits = mix64(mix64(seed) + 0x9e3779b97f4a7c15u * (counter + 1));
    return static_cast<float>(static_cast<int64_t>(bits >> 40) - (1 << 23)) * 0x1p-23f;
}

// Word-wise hash in the manner of FNV-1a, finished by mix64.
class Hash {
  public:
    void add(const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; size >= 8; bytes += 8, size -= 8)
            add_word(bytes, 8);
        if (size > 0)
            add_word(bytes, size);
    }
    template <typename T> void add(const T& value) { add(&value, sizeof value); }
    uint64_t value() const { return mix64(state_); }

  private:
    void add_word(const unsigned char* bytes, size_t size) {
        uint64_t word = 0;
        std::memcpy(&word, bytes, size);
        state_ = (state_ ^ word) * 0x100000001b3u;
        state_ ^= state_ >> 29; // FNV alone never carries high bits down
    }
    uint64_t state_ = 0xcbf29ce484222325u;
};

} // namespace plait
