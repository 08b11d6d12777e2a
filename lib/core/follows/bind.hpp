// Follow maps that are bound where hair hangs: turns are taken since then, not since the groom.
#pragma once

#include "core/follows/hair_frame.hpp"

namespace plait {

// Are map.bound the guides, whose groom has these, with their roots where they are there? A map without
// is right. INVALID_ARGUMENT names what was bound by, `name`, the guide, the value and the range.
Status check_bound(const FollowMap& map, std::span<const float> guides,
                   std::span<const uint32_t> vertex_counts, const char* name);

// `map` with its strands and guides where they are in `frame`; `out` is empty before, `groom` has all
// of the map's strands. INVALID_ARGUMENT: that it has not, and what check_bound says.
Status bind_map(const Groom& groom, const FollowMap& map, const RootPoses& roots,
                const HairFrame& frame, FollowMap& out, const char* name);

} // namespace plait
