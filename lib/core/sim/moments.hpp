// The moments of a call of plait_sim_step, at which phases append what they do.
#pragma once

#include "core/strands/model.hpp"

#include <cstdint>

namespace plait {

enum class Moment {
    call_begins,
    step_begins,
    substep,
    step_ends,
    sums_reduced, // by the caller, where he does
    call_ends
};

struct At {
    Moment moment;
    StepInput substep;
    uint32_t step = 0, steps = 0; // which fixed step of how many in the call
    float end = 1;                // share of the call at which that step ends
};

// A number of substeps that some strands take.
struct Group {
    uint32_t substeps;
    uint32_t first; // those of the groups before
};

} // namespace plait
