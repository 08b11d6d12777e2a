// What each level of detail of a head of hair costs, and how far its hair is from where it belongs.
#pragma once

#include "methods/models.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace lab::levels {

struct LevelsOptions {
    std::vector<std::string> styles = {"long", "curly", "short"};
    uint32_t strands = 4000;
    double seconds = 3; // of each motion
    std::string out = "out/lab";
};

// The motions, in the order of LevelRow::share: a head that shakes, one that turns and nods, a gust.
constexpr const char* motion_names[] = {"shake", "nod", "gust"};
constexpr size_t motion_count = 3;

// Errors are rms distances from where all strands are in four substeps, over the swing: their rms
// distance from their mean there, in the head's frame.
struct LevelRow {
    std::string style;
    uint32_t guides = 0;
    double ms = 0;       // of a frame of 1/60 s, the least; 0: nothing is simulated
    double of_whole = 0; // that over what it is where all strands are simulated
    double share[motion_count] = {};
    double all = 0;    // rms over the motions
    double median = 0; // of strands, in all motions
    float listed = 0;  // plait_level.share: what the library expects
};

std::vector<LevelRow> measure_levels(Contexts& contexts, const LevelsOptions& options);

std::string levels_text(const std::vector<LevelRow>& rows);
std::string levels_csv(const std::vector<LevelRow>& rows);
// <out>/levels.svg and .png: error over cost. False: there is no gnuplot.
bool draw_levels(const std::vector<LevelRow>& rows, const LevelsOptions& options);

} // namespace lab::levels
