#include "crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace simulate {

namespace {

// Each as many times farther than the one before.
float distance_of(uint32_t head, uint32_t heads) {
    const float share = heads > 1 ? static_cast<float>(head) / static_cast<float>(heads - 1) : 0.0f;
    return Crowd::nearest * std::pow(Crowd::farthest / Crowd::nearest, share);
}

float pixels_per_metre(float distance) {
    constexpr float lines = 1080.0f, half_view = 20.0f * std::numbers::pi_v<float> / 180.0f;
    return lines / (2.0f * std::tan(half_view) * distance);
}

} // namespace

Crowd::Crowd(plait_context* context, const std::vector<plait_sim*>& sims, const CrowdChoice& choice)
    : context_(context), sims_(sims), budget_ms_(choice.budget_ms) {
    for (uint32_t i = 0; i < sims.size(); ++i) {
        const float distance = distance_of(i, static_cast<uint32_t>(sims.size()));
        heads_.push_back({distance, pixels_per_metre(distance), {}});
        plait_character character = plait_character_defaults();
        character.sim = sims[i];
        character.pixels_per_metre = heads_.back().pixels_per_metre;
        characters_.push_back(character);
    }
}

// So small a tolerance that heads spend all of the budget.
void Crowd::direct(double dt) {
    plait_director_desc desc = plait_director_desc_defaults();
    desc.budget_ms = budget_ms_;
    desc.tolerance_px = 0.05f;
    desc.last_ms = static_cast<float>(std::min(last_ms_, 1e4));
    check(
        plait_context_direct(context_, characters_.data(), characters_.size(), &desc, dt, nullptr));
}

void Crowd::step(double dt) {
    check(plait_context_step(context_, sims_.data(), sims_.size(), dt));
}

void Crowd::wait() {
    for (plait_sim* const sim : sims_)
        check(plait_sim_wait(sim));
}

void Crowd::record(uint32_t frame) {
    for (size_t i = 0; i < sims_.size(); ++i) {
        plait_level_state now = plait_level_state_defaults();
        check(plait_sim_get_level(sims_[i], &now));
        std::vector<LevelChange>& levels = heads_[i].levels;
        if (levels.empty() || levels.back().level != now.level || levels.back().shown != now.shown)
            levels.push_back({frame, now.level, now.shown});
    }
}

} // namespace simulate
