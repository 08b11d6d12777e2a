// The hair at one moment.
#pragma once

#include <plait/plait.h>

#include <cstdint>
#include <span>
#include <string>

namespace simulate {

struct Shot {
    uint32_t frame = 0;
    float time = 0.0f; // s
    plait_pose head{};
    std::span<const float> positions;       // [strands][row][4], m; the fourth is anything
    std::span<const uint32_t> vertex_count; // [strands]
    uint32_t row = 0;
    float widen = 1.0f;     // as much as there are fewer strands than the hair has
    std::string level = {}; // ", level 2"; empty where it does not change
};

} // namespace simulate
