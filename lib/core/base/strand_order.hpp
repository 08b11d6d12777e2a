// The order in which strands take lanes: those that share a work-item should grow side by side,
// for what one of them has to look at, all look at (which colliders are near, above all).
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace plait {

// Strands along a Morton curve through their roots; equal codes keep the groom's order.
// `positions`: xyz of every vertex, strand after strand; `counts`: vertices of each strand, one at
// least.
std::pmr::vector<uint32_t> order_by_root(std::span<const float> positions,
                                         std::span<const uint32_t> counts,
                                         std::pmr::memory_resource* memory);
// The same block by block, so that each of `ends`, ascending and the last of all strands, is that many
// lanes, too; empty: one block.
std::pmr::vector<uint32_t> order_by_root(std::span<const float> positions,
                                         std::span<const uint32_t> counts,
                                         std::span<const uint32_t> ends,
                                         std::pmr::memory_resource* memory);

} // namespace plait
