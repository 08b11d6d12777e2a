// What every harness demands of a reader: an error, or strands that are whole and that survive
// being written and read again.
#pragma once

#include "io/formats.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace plait::fuzz {

inline void demand(bool truth, const char* what) {
    if (truth)
        return;
    std::fprintf(stderr, "broken: %s\n", what);
    std::abort();
}

inline std::span<const std::byte> bytes_of(const uint8_t* data, size_t size) {
    return std::as_bytes(std::span(data, size));
}

// Bit by bit, because a NaN is to survive too.
inline bool same(const std::pmr::vector<float>& a, const std::pmr::vector<float>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

inline void demand_arrays_agree(const StrandSet& strands) {
    const size_t count = strands.vertex_counts.size();
    uint64_t vertices = 0;
    for (uint32_t n : strands.vertex_counts)
        vertices += n;
    demand(count > 0, "a file that was read has strands");
    demand(strands.positions.size() == 3 * vertices, "vertex counts sum to the positions");
    for (size_t size : {strands.strand_uv.size() / 2, strands.thickness.size(),
                        strands.bone_indices.size() / 4, strands.bone_weights.size() / 4})
        demand(size == 0 || size == count, "arrays of strands have one entry for each");
}

inline void demand_whole(const StrandSet& strands, size_t file_size) {
    demand_arrays_agree(strands);
    const size_t count = strands.vertex_counts.size(), vertices = strands.positions.size() / 3;
    demand(count <= file_size && vertices <= file_size, "no more strands than bytes");
}

// Of files whose objects may share arrays, and whose cubic curves have up to 32 chords for each span.
inline void demand_whole_curves(const StrandSet& strands, size_t file_size) {
    demand_arrays_agree(strands);
    const size_t points = strands.positions.size() / 3;
    demand(points <= 32 * std::max<size_t>(file_size, 64 << 20), "no more points than is allowed");
}

} // namespace plait::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
