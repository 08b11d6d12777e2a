// Guides and strands that follow the nearest of them: other strands of their groom, or those of another.
#pragma once

#include "core/follows/follow_map.hpp"
#include "core/follows/root_spread.hpp"

namespace plait {

// Where strands leave the scalp, and which way they go.
StrandRoots roots_of(const StrandSet& strands, std::pmr::memory_resource* memory);

// `guides` and `follows` are strands of `groom`, whose roots are given, in the order in which they
// come out. `out` and `map` are empty before.
Status follow_nearest(const Groom& groom, const StrandRoots& roots,
                      std::span<const uint32_t> guides, std::span<const uint32_t> follows,
                      Groom& out, FollowMap& map);

// The strands of `map`, which has no guides yet, follow the nearest of `guides`.
Status follow_nearest(const Groom& guides, FollowMap& map);

} // namespace plait
