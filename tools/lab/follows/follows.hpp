// Hair of which some is simulated and the rest follows, against all of it simulated.
#pragma once

#include "methods/models.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace lab::follows {

struct FollowOptions {
    std::string style = "long";
    uint32_t strands = 20000;
    std::vector<uint32_t> guides = {128, 500, 2000};
    double seconds = 4; // of a head that shakes
};

// Of a sim; the last of a run is that of all strands.
struct FollowRow {
    uint32_t guides = 0;
    double wall = 0;   // ms of a frame of 1/60 s, median
    double length = 0; // worst |l/l0 - 1| of a segment
    double kink = 0;   // deg: worst change of the angle between two segments, of all frames
    double step = 0;   // worst of a frame's tip steps of follows over the guides' in it
    double beside =
        0;           // least distance of neighbours over that at rest: of a hundredth of them less
    double away = 0; // m, rms distance of the strands from where all are simulated
};

std::vector<FollowRow> measure_follows(Contexts& contexts, const FollowOptions& options);

std::string follows_text(const std::vector<FollowRow>& rows);
std::string follows_csv(const std::vector<FollowRow>& rows);

} // namespace lab::follows
