// Follow strands near guides, for the stages that change what is shown of them.
#pragma once

#include "inputs.hpp"

namespace plait::cases {

struct FollowHair {
    uint32_t follows;
    std::vector<float> arc;      // [follows][V], m
    std::vector<float> position; // float4, the guides, then the follows
};
// Each begins beside one of the guides and winds another way, some with two vertices.
FollowHair follow_hair(const Hair& guides);

// Rows of guides, or of follows, which are their own.
std::vector<uint32_t> clump_centres(const Size& size, uint32_t follows);

} // namespace plait::cases
