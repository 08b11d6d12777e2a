// Snapshots with a right checksum, whatever is in them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace forged {

// Of the head, bytes: where the checksum is, from where on it covers.
constexpr size_t checksum_at = 8, covered_from = 16;
// Of the head of a block: its tag, its version, how many bytes follow it.
constexpr size_t version_at = 4, bytes_at = 8, block_head = 16;

// As base/hash.hpp does it.
inline uint64_t hash_of(const unsigned char* bytes, size_t size) {
    uint64_t state = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        std::memcpy(&word, bytes + i, std::min<size_t>(8, size - i));
        state = (state ^ word) * 0x100000001b3u;
        state ^= state >> 29;
    }
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
    return state ^ (state >> 31);
}

// Where the head of the block with this tag is; the snapshot's size: there is none.
inline size_t find_block(const std::vector<unsigned char>& bytes, const char (&tag)[5]) {
    size_t at = covered_from;
    while (at < bytes.size() && std::memcmp(&bytes[at], tag, 4) != 0) {
        uint64_t size = 0;
        std::memcpy(&size, &bytes[at + bytes_at], sizeof size);
        at += block_head + static_cast<size_t>(size);
    }
    return at;
}

inline void sign(std::vector<unsigned char>& bytes) {
    const uint64_t checksum = hash_of(bytes.data() + covered_from, bytes.size() - covered_from);
    std::memcpy(bytes.data() + checksum_at, &checksum, sizeof checksum);
}

} // namespace forged
