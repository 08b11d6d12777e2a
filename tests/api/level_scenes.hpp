// Levels of small grooms, and choices among them, for the tests of the C API.
#pragma once

#include "support.hpp"

#include <algorithm>
#include <functional>

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

// The head says "no", and stands still after `still` frames.
inline plait_roots shaken(double step, double still = 1e9) {
    const auto half = static_cast<float>(0.2 * std::sin(0.12 * std::min(step, still)));
    return head_at({0, 0, 0}, {0, std::sin(half), 0, std::cos(half)});
}

struct Scene {
    plait::Groom groom;
    plait::Levels levels;
    size_t strands, row;

    Scene(const Strands& hair, const std::vector<uint32_t>& guides)
        : groom(make_groom(hair)), levels(levels_of(groom, guides)), strands(hair.size()), row(0) {
        for (const Strand& strand : hair)
            row = std::max(row, strand.size());
    }
    plait::Sim sim(const plait::Context& context, uint32_t top = 0,
                   const std::function<void(plait::SimDesc&)>& change = {}) const {
        plait::SimDesc desc;
        desc.levels = levels;
        desc.level_top = top;
        if (change)
            change(desc);
        return plait::Sim(context, groom, desc);
    }
};

inline const std::vector<uint32_t> ladder = {256, 64, 16, 0};
inline Scene hair() {
    return Scene(field(16), ladder);
}

inline void move(plait::Sim& sim, double step, double still = 1e9) {
    sim.set_roots(shaken(step, still));
    sim.step(slightly_more);
}

inline std::vector<float> shown(const plait::Sim& sim) {
    return sim.read(PLAIT_FIELD_POSITION);
}
