// Heads of one groom within a budget: which level each gets, frame by frame.
#pragma once

#include "common.hpp"

#include <plait/plait_levels.h>

#include <cstdint>
#include <vector>

namespace simulate {

// What the budget is for: heads that stand in a row away from the viewer.
struct CrowdChoice {
    float budget_ms = 0.0f; // for the hair of all in a frame; 0: no budget
    uint32_t heads = 1;
    bool directed() const { return budget_ms > 0.0f; }
};

// From a frame on.
struct LevelChange {
    uint32_t frame, level, shown; // shown: strands that are placed
};

struct CrowdHead {
    float distance;         // m
    float pixels_per_metre; // of a picture of 1080 lines whose view is 40 degrees high
    std::vector<LevelChange> levels;
};

class Crowd {
  public:
    static constexpr float nearest = 0.7f, farthest = 30.0f; // m

    // `sims`: the nearest first; they outlive it.
    Crowd(plait_context* context, const std::vector<plait_sim*>& sims, const CrowdChoice& choice);

    // Once a frame, before the step. Throws Failure, as do the others.
    void direct(double dt);
    void step(double dt); // of all, without waiting
    void wait();
    void took(double ms) { last_ms_ = ms; } // the frame
    double last_ms() const { return last_ms_; }
    void record(uint32_t frame); // after it
    const std::vector<CrowdHead>& heads() const { return heads_; }

  private:
    plait_context* context_;
    std::vector<plait_sim*> sims_;
    std::vector<plait_character> characters_;
    std::vector<CrowdHead> heads_;
    float budget_ms_;
    double last_ms_ = 0.0;
};

} // namespace simulate
