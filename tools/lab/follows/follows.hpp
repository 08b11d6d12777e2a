// Hair of which some is simulated and the rest follows, against all of it simulated.
#pragma once

#include "methods/models.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace lab::follows {

struct FollowOptions {
    std::string style = "long";
    uint32_t strands = 4000;
    std::vector<uint32_t> guides = {32, 128, 500};
    double lesson = 4;  // s of a head that shakes, which weights are learnt from; 0: none are
    double seconds = 4; // of one that turns and nods, which is measured
    std::string out = "out/lab";
};

enum class Weights { none, near, learnt }; // none: all strands are simulated

// Of a sim; the last of a run is that of all strands.
struct FollowRow {
    uint32_t guides = 0;
    Weights weights = Weights::near;
    double wall = 0;      // ms of a frame of 1/60 s, the least
    double of_whole = 0;  // that over what it is where all strands are simulated
    double away = 0;      // m, rms distance of the vertices from where all strands are simulated
    double away_most = 0; // m, the greatest
    double length = 0;    // worst |l/l0 - 1| of a segment
    double kink = 0;      // deg: worst change of the angle between two segments, of all frames
    double step = 0;      // worst of a frame's tip steps of follows over the guides' in it
    // Least distance of neighbours over that at rest: of a hundredth of them less.
    double beside = 0;
    std::vector<double> curve; // m, away in every frame
};

std::vector<FollowRow> measure_follows(Contexts& contexts, const FollowOptions& options);

std::string follows_text(const std::vector<FollowRow>& rows);
std::string follows_csv(const std::vector<FollowRow>& rows);
std::string follows_curves(const std::vector<FollowRow>& rows); // time and a column for each row
// <out>/follows.svg and .png: distance over guides, and over time. False: there is no gnuplot.
bool draw_follows(const std::vector<FollowRow>& rows, const FollowOptions& options);

constexpr double rate = 60; // frames a second

} // namespace lab::follows
