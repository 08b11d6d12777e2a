// Several sims of one context in one step.
#pragma once

#include "base/format.hpp"
#include "core/sim/sim.hpp"

namespace plait {

// Sequences of a device that may overlap, ended however the call ends.
class Overlap {
  public:
    explicit Overlap(Device& device) : device_(device) {}
    Overlap(const Overlap&) = delete;
    Overlap& operator=(const Overlap&) = delete;
    ~Overlap() { (void)end(); }

    Status next() {
        const Status status = device_.overlap(begun_ ? PLAIT_OVERLAP_NEXT : PLAIT_OVERLAP_BEGIN);
        begun_ = begun_ || status.ok();
        return status;
    }
    Status end() {
        return std::exchange(begun_, false) ? device_.overlap(PLAIT_OVERLAP_END) : Status{};
    }

  private:
    Device& device_;
    bool begun_ = false;
};

// Sims sim_at(0) to sim_at(count - 1), which are different ones. Where one fails those after it are
// left as they were. With profiling each is submitted by itself, as its times are its own; and where one
// waits in its step for the other parts of its groom.
template <typename SimAt>
Status step_together(Context& context, size_t count, const SimAt& sim_at, double dt) {
    bool overlaps = count > 1 && !context.profile;
    for (size_t i = 0; i < count && overlaps; ++i)
        overlaps = !sim_at(i).is_part();
    Overlap overlap(context.device);
    for (size_t i = 0; i < count; ++i) {
        Status status = overlaps ? overlap.next() : Status{};
        if (status)
            status = sim_at(i).step(dt);
        if (!status)
            return Error{status.error().code,
                         format("sims[%zu]: %s", i, status.error().message.c_str())};
    }
    PLAIT_TRY(overlap.end());
    for (size_t i = 0; i < count; ++i)
        PLAIT_TRY(sim_at(i).ask_for_probes());
    return {};
}

} // namespace plait
