// Commands that were enqueued and have not been looked at since: what they cost, how they ended.
#pragma once

#include "backend/launches.hpp"
#include "backend/opencl/handles.hpp"
#include "base/result.hpp"

#include <plait/plait_backend.h>

#include <array>
#include <deque>

namespace plait::opencl {

class Flight {
  public:
    void count(plait_stage stage) { ++costs_[stage].calls; }
    void add(Event event, const plait_dispatch& dispatch) {
        events_.push_back(
            {std::move(event), {dispatch.stage, dispatch.item_count, dispatch.bytes, 0, 0, 0}});
    }

    // Takes every ended command off the front: as many events are kept as the queue itself holds
    // commands. Returns the first failure among the ended.
    Status collect(bool profile);

    const std::array<plait_stage_cost, PLAIT_STAGE_COUNT>& costs() const { return costs_; }
    void reset_costs() { costs_ = {}; }
    void take_launches(plait_stage_launch* dst, size_t& count) { launches_.take(dst, count); }

  private:
    struct Command {
        Event event;
        plait_stage_launch launch; // its times are known when it has ended
    };

    Status take(const Command& command, cl_int status, bool profile);
    void record(const Command& command);

    std::deque<Command> events_;
    std::array<plait_stage_cost, PLAIT_STAGE_COUNT> costs_{};
    Launches launches_;
};

} // namespace plait::opencl
