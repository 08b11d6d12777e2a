// Where on a guide what a follow takes from it is.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Where the middle of each segment is, as a share of its strand's length: of all
// strands, one after the other, and where each strand's begin.
struct Middles {
    std::pmr::vector<double> at;
    std::pmr::vector<size_t> first;

    std::span<const double> of(size_t strand) const {
        return std::span(at).subspan(first[strand], first[strand + 1] - first[strand]);
    }
};

Middles middles_of(std::span<const float> positions, std::span<const uint32_t> vertex_counts,
                   std::pmr::memory_resource* memory);

// a + t: `share` is t of the way from the middle of segment a to that of a + 1. Beside a middle t is 0.
float place_in(std::span<const double> middles, double share);

} // namespace plait
