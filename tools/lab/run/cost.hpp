// What a method costs on a scene: many copies of its strands, stepped and waited for.
#pragma once

#include "recording.hpp"

namespace lab {

struct Cost {
    uint64_t vertices = 0;
    uint32_t runs = 0; // steps timed; 0: given up, beyond the dearest
    double wall = 0;   // s per fixed step, median; launches and the wait included
    double kernel = 0; // s per fixed step on the device's clock, all stages; 0: not measured
    double step = 0;   // s simulated by it

    double ns_per_vertex() const;
    double ms_per_frame() const; // wall, of 1/60 s of simulated time, a million vertices
    double strands_at_60_hz(uint32_t vertices_per_strand) const; // in real time
};

struct CostOptions {
    uint64_t vertices = 100000; // at least
    uint32_t runs = 21;         // steps, at most:
    bool kernel = true;
    double seconds = 2;   // of timing; once they are over, three steps are enough
    double dearest = 1e9; // ms per 1/60 s and million vertices: dearer methods are given up
};

Cost measure_cost(Contexts& contexts, Contexts& profiled, const Scene& scene, const Method& method,
                  const CostOptions& options);

} // namespace lab
