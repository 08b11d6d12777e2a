// Pins: points that vertices are held at. The buffers are state's and hold a row for every vertex;
// here is their way through the time between calls, which is that of roots, and how a list of them
// becomes rows.
#pragma once

#include "core/base/schedule.hpp"
#include "core/strands/state.hpp"

#include <array>
#include <span>
#include <vector>

namespace plait {

// Makes the buffers, in which nothing is pinned, or none of them. Waits.
Status open_pins(Device& device, const Layout& layout, State& state,
                 std::pmr::memory_resource* memory);
void close_pins(State& state);

// None of these does anything in a sim without pins. `scale`: m, one of the groom's units; targets in the
// world come in metres.
// A fixed step begins: what was pin_to is pin_from. append_pin_targets() is due.
void advance_pins(State& state);
// Where they are at `end` of the call, [0, 1], as pin_to.
void append_pin_targets(Schedule& schedule, const Layout& layout, const State& state, float end,
                        float scale);
// The call is over: they are where the caller wants them.
void append_pins_arrived(Schedule& schedule, const Layout& layout, const State& state, float scale);
// They have come no way.
void append_stopped_pins(Schedule& schedule, const Layout& layout, const State& state, float scale);
// Waits.
Status clear_pins(Device& device, const Layout& layout, const State& state,
                  std::pmr::memory_resource* memory);

// Of [guides*V] rows: |w| within its range, and 0 at roots.
Status check_pin_stiffness(std::span<const float> rows, uint32_t row);

// What of the groom a list of pins needs.
class PinTable {
  public:
    using Row = std::array<float, 4>;

    explicit PinTable(std::pmr::memory_resource* memory) : rest_(memory), counts_(memory) {}

    // From the device, which the first call waits for.
    Status fill(Device& device, const Layout& layout, const State& state);
    Result<std::pmr::vector<Row>> rows(std::span<const plait_pin> pins) const;

  private:
    Status check(const plait_pin& pin, size_t index) const;

    uint32_t row_ = 0;
    std::pmr::vector<Row> rest_;        // [guides*V]
    std::pmr::vector<uint32_t> counts_; // [strands]; of these guides come first
};

} // namespace plait
