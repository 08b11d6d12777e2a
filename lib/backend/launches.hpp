// Launches that have ended and that nobody has taken yet: the newest, oldest first.
#pragma once

#include <plait/plait_backend.h>

#include <algorithm>
#include <cstddef>
#include <deque>

namespace plait {

class Launches {
  public:
    void add(const plait_stage_launch& launch) {
        if (kept_.size() == PLAIT_LAUNCHES_KEPT)
            kept_.pop_front();
        kept_.push_back(launch);
    }

    size_t size() const { return kept_.size(); }
    const plait_stage_launch& operator[](size_t i) const { return kept_[i]; }

    void forget(size_t count) {
        kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(count));
    }

    // The contract of plait_device_api.take_launches.
    void take(plait_stage_launch* dst, size_t& count) {
        count = dst ? std::min(count, size()) : size();
        if (!dst)
            return;
        std::copy_n(kept_.begin(), count, dst);
        forget(count);
    }

  private:
    std::deque<plait_stage_launch> kept_;
};

} // namespace plait
