// Programs made before anything runs them.
#pragma once

#include "core/sim/context.hpp"

#include <functional>
#include <span>

namespace plait {

struct Groom;

// What sims will be of and have.
struct Preparation {
    uint32_t models;                // bits 1u << plait_model
    uint32_t features;              // bits of plait_feature
    std::span<const uint32_t> rows; // vertices of the longest strand of each class of length
    uint32_t row;                   // of all strands, V
    uint32_t strands;               // 0: nobody knows
    // Before each stage and at the end (""), of how many; false: no further.
    std::function<bool(uint32_t done, uint32_t total, const char* stage)> progress;
};

// Builds the stages that such sims take in steps and calls, one after the other.
// @errors UNSUPPORTED, COMPILE, CANCELLED
Status prepare(Context& context, const Preparation& preparation);

} // namespace plait
