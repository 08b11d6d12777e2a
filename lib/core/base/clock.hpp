// Fixed steps out of the time between calls.
#pragma once

#include <cstdint>

namespace plait {

// What one call of plait_sim_step is to do.
struct Tick {
    double dt = 0;        // s, the call
    double behind = 0;    // s, time already waiting when the call began
    double step = 0;      // s
    uint64_t dropped = 0; // steps that are left out, before the others
    uint32_t steps = 0;

    // Where in the call fixed step k (0-based) ends, [0, 1]. The step that straddles the call's
    // beginning started on the path of the call before.
    double end_of(uint32_t k) const { return share(double(dropped) + k + 1); }
    // Where time that is left out ends, and the first step begins.
    double end_of_dropped() const { return share(double(dropped)); }

  private:
    double share(double steps_done) const;
};

class Clock {
  public:
    Clock(float step, uint32_t max_steps_per_call);

    double step() const { return step_; }
    // Share of a fixed step that waits for the next call, [0, 1].
    double remainder() const;
    double time() const { return double(steps) * step_; }

    Tick advance(double dt);
    // Time that waits is left out: a step begins now.
    void begin_step() { waiting = 0; }
    void reset();

    // Plain state, saved and restored.
    double waiting = 0; // s
    uint64_t steps = 0;
    uint64_t dropped = 0;

  private:
    double step_; // s
    uint32_t max_steps_;
};

} // namespace plait
