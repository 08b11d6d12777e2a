// Where the time of a frame goes, stage by stage, and how near each stage comes to what the
// device's memory gives.
#pragma once

#include "run.hpp"

namespace simulate {

// Means over the frames of a run.
struct StageProfile {
    std::string stage;
    double calls = 0; // a frame
    double us = 0;    // a frame, on the device
    double bytes = 0; // a frame, that it has to move at least
    double bytes_per_second() const { return us > 0 ? 1e6 * bytes / us : 0.0; }
};

struct HostProfile {
    std::string call;
    double us = 0; // a frame
};

struct Profile {
    std::vector<StageProfile> stages; // the slowest first
    std::vector<HostProfile> host;    // in the order of a frame
    double vertices = 0;              // of the groom
    double frame_us = 0;              // wall time
    double stages_us = 0;             // of all stages together
    double copy_rate = 0;             // bytes/s of a copy of memory; 0: not measured
    bool has_device_times = false;
    double other_us() const { return frame_us - stages_us; }
};

Profile make_profile(const Measurements& run, uint64_t vertices, double copy_rate);

Json to_json(const Profile& profile);
std::string to_text(const Profile& profile);

} // namespace simulate
