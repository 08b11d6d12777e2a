// What came of a sag-free start.
#pragma once

#include <cstdint>

namespace plait {

struct SagReport {
    double residual = 0;    // worst joint: moment missing / (weight * length), or force / weight
    uint64_t unreached = 0; // strands whose residual is above `reached`
    uint64_t unstable = 0;  // strands whose groomed shape is no stable equilibrium
    uint64_t joints = 0;
    uint64_t stiffened = 0;  // joints
    double stiffening = 1.0; // worst joint: its stiffness / the material's
    uint64_t residual_strand = 0, stiffening_strand = 0; // the worst ones

    // A strand gives 1 % at 10 g, so its EA is a thousand of its weights: of a force of EA the
    // device's float32 loses as much.
    static constexpr double reached = 1e-4;

    void add(const SagReport& other);
    void add(SagReport of_one, uint64_t strand);
};

} // namespace plait
