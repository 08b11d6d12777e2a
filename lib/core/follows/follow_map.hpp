// Strands that are not simulated, and the guides that each takes its turns from.
#pragma once

#include "base/result.hpp"
#include "core/groom/groom.hpp"

#include <span>

namespace plait {

struct FollowMap {
    static constexpr size_t per_strand = 4; // guides, at most

    explicit FollowMap(std::pmr::memory_resource* memory)
        : strands(memory), guides(memory), weights(memory), bound(memory), origin(memory) {}

    size_t count() const { return strands.vertex_counts.size(); }

    StrandSet strands;                 // at rest; of their fields positions and counts are read
    uint32_t max_vertices = 0;         // of them
    uint32_t guide_count = 0;          // strands of the groom that simulates
    std::pmr::vector<uint32_t> guides; // [4*count]; one of weight 0 is the strand's first
    std::pmr::vector<float> weights;   // [4*count], the greatest first; of a strand they sum to 1
    // [3*vertices of all guides]: where guides are while `strands` are as they are; empty: as groomed.
    std::pmr::vector<float> bound;
    // [guide_count + count]: which strand of the groom they were chosen from; or empty.
    std::pmr::vector<uint32_t> origin;
};

// Fills guides and weights of a map that has its strands: [4*count] each, in any order, weights sum
// to 1 within 1e-3. INVALID_ARGUMENT names the strand, the place, the value and the range.
Status set_guides(FollowMap& map, std::span<const uint32_t> guides, std::span<const float> weights);

// `guides` strands of `groom` that are spread evenly over its roots; those that are left follow
// their nearest ones. `out` and `map` are empty before.
Status choose_guides(const Groom& groom, size_t guides, uint64_t seed, Groom& out, FollowMap& map);

// The strands of `follows` follow the guides that they name, or where none of them names any the nearest.
// `map` is empty before. BAD_DATA names the follow, by its number, the value and what is allowed.
Status follow_named(const Groom& guides, const Groom& follows, FollowMap& map);

} // namespace plait
