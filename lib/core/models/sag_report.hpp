// What came of a sag-free start.
#pragma once

#include <cstdint>

namespace plait {

struct SagReport {
    double residual = 0;     // worst joint: moment missing / (weight * length), or force / weight
    uint64_t unstable = 0;   // strands whose groomed shape is no stable equilibrium
    uint64_t stiffened = 0;  // joints
    double stiffening = 1.0; // worst joint: its stiffness / the material's

    void add(const SagReport& strand);
};

} // namespace plait
