#include "core/base/clock.hpp"

#include <algorithm>
#include <cmath>

namespace plait {
namespace {

// float32 cannot say 1/60: what is within its rounding of n (or of n steps) is meant to be n.
double snap(double ratio) {
    const double nearest = std::round(ratio);
    return nearest >= 1 && std::abs(ratio - nearest) <= 1.2e-7 * nearest ? nearest : ratio;
}

constexpr double tolerance = 1e-6; // of a step: sums of dt that miss a whole step by rounding

} // namespace

double Tick::share(double steps_done) const {
    const double end = step * steps_done - behind;
    return dt > 0 ? std::clamp(end / dt, 0.0, 1.0) : 1.0;
}

Clock::Clock(float step, uint32_t max_steps_per_call)
    : step_(1 / snap(1 / double(step))), max_steps_(max_steps_per_call) {}

double Clock::remainder() const {
    return std::clamp(waiting / step_, 0.0, 1.0);
}

Tick Clock::advance(double dt) {
    const double exact = step_ * snap(dt / step_);
    Tick tick;
    tick.dt = exact;
    tick.behind = waiting;
    tick.step = step_;
    waiting += exact;
    const auto due = static_cast<uint64_t>(std::max(std::floor(waiting / step_ + tolerance), 0.0));
    tick.steps = static_cast<uint32_t>(std::min<uint64_t>(due, max_steps_));
    waiting -= double(due) * step_;
    tick.dropped = due - tick.steps;
    dropped += tick.dropped;
    return tick;
}

void Clock::reset() {
    waiting = 0;
    steps = 0;
    dropped = 0;
}

} // namespace plait
