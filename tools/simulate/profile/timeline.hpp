// What the host called and what the device ran, frame by frame.
#pragma once

#include <plait/plait_profile.h>

#include <chrono>
#include <cstdint>
#include <vector>

namespace simulate {

struct HostCall {
    const char* name;
    uint32_t frame;
    bool enqueues; // what the frame's launches come of
    bool of_frame; // and not of looking at what came of it
    uint64_t begin_ns, end_ns;
};

struct Launch {
    uint32_t frame;
    plait_launch run;
};

class Timeline {
  public:
    static uint64_t now_ns() {
        using namespace std::chrono;
        return static_cast<uint64_t>(
            duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count());
    }

    void add(const HostCall& call) { calls_.push_back(call); }
    void add(const Launch& launch) { launches_.push_back(launch); }

    const std::vector<HostCall>& calls() const { return calls_; }
    const std::vector<Launch>& launches() const { return launches_; } // of frames, in order
    bool has_device_times() const {
        for (const Launch& launch : launches_)
            if (launch.run.end_ns > launch.run.begin_ns)
                return true;
        return false;
    }

  private:
    std::vector<HostCall> calls_;
    std::vector<Launch> launches_;
};

} // namespace simulate
