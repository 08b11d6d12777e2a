// How wet the strands of a sim are: what the host knows of it, and the stage that lets them dry.
#pragma once

#include "core/base/part.hpp"
#include "core/base/schedule.hpp"
#include "core/strands/state.hpp"

#include <memory_resource>
#include <span>

namespace plait {

// INVALID_ARGUMENT names the strand, its value and the range.
Status check_wetness(std::span<const float> wetness);

class Wetness {
  public:
    // Buffers of `state`, of dry strands; where one cannot be made none is.
    static Status open(Device& device, const Layout& layout, State& state,
                       std::pmr::memory_resource* memory);
    static void close(State& state);

    // From now on `wetness`, [guides], of which none is outside its range.
    Status give(Device& device, const State& state, std::span<const float> wetness);
    // The same of a snapshot, when so much time had gone by since. `given`: what is in `state`.
    Status resume(Device& device, const State& state, double dried,
                  std::pmr::memory_resource* memory);
    // Time goes by, s; `drying_time` 0: nothing dries.
    void pass(double time, double drying_time);
    bool is_dry() const; // all strands are
    // Appends what puts wetness to where it is by now.
    void append(Schedule& schedule, const Layout& layout, const State& state) const;
    // Appends what scales a part's material by it.
    static void append_material(Schedule& schedule, const Part& part, const State& state);

    double dried() const { return dried_; } // time since it was given, over the drying time

  private:
    float left() const;
    float now(float given) const; // as the stage has it

    double dried_ = 0;
    float most_ = 0; // that was given
};

} // namespace plait
