// Where all strands of a groom are at one moment, as a caller gives it, for what is made of a map's
// strands together.
#pragma once

#include "core/base/pose.hpp"
#include "core/follows/follow_map.hpp"

#include <array>
#include <span>

namespace plait {

// Of every strand a row of `row` vertices, float[3], `stride` bytes apart.
struct HairFrame {
    const unsigned char* positions = nullptr;
    size_t stride = 0;
    size_t row = 0;
    double scale = 1; // m, one of the groom's units

    std::array<double, 3> at(size_t strand, size_t vertex) const; // in the groom's units
};

// INVALID_ARGUMENT names the place in `name`, the value and the range.
Status check_frame(const RootPoses& roots, const HairFrame& frame,
                   std::span<const uint32_t> vertex_counts, const char* name = "positions");

// Which strands of `groom` the map's guides are, and then its follows.
std::pmr::vector<uint32_t> origin_of(const FollowMap& map, std::pmr::memory_resource* memory);
// INVALID_ARGUMENT: `groom` is not made of the strands of `map`, whose origin is given.
Status check_strands(const Groom& groom, const FollowMap& map, std::span<const uint32_t> origin);

} // namespace plait
