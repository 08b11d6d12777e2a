// Levels of small grooms, and choices among them, for the tests of the C API.
#pragma once

#include "support.hpp"

#include <algorithm>

constexpr double slightly_more = frame + 1e-9; // so that every call makes one step

inline plait_level_choice choice_of(uint32_t level, float blend = 0.3f, uint32_t shown = 0) {
    auto choice = plait_level_choice_defaults();
    choice.level = level;
    choice.blend = blend;
    choice.shown = shown;
    return choice;
}

// `guides`: of each level. `hung`: where all strands hang, rows of float4; empty: as groomed.
inline plait::Levels levels_of(const plait::Groom& groom, const std::vector<uint32_t>& guides,
                               const std::vector<float>& hung = {}) {
    auto desc = plait_levels_desc_defaults();
    desc.groom = groom;
    desc.level_count = static_cast<uint32_t>(guides.size());
    std::ranges::copy(guides, desc.guides);
    if (!hung.empty())
        desc.hung = {hung.data(), hung.size() / 4, 16};
    return plait::Levels(desc);
}
