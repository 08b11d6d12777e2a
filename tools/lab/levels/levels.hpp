// What each level of detail of a head of hair costs, and how far its hair is from where it belongs.
#pragma once

#include "follows/head.hpp"
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
    bool transfer = false; // all motions, and how well errors of the others are told
};

// A head that moves, and a gust from the side.
struct LevelMotion {
    const char* name;
    follows::Motion head;
    float gust; // m/s
};
// Sixteen; `shares` says of which the table has columns. What a level is wrong by in the lesson is to tell what it is
// wrong by in all others.
const std::vector<LevelMotion>& level_motions();
constexpr size_t shares[] = {0, 1, 2}; // shake, nod, gust
constexpr size_t lesson[] = {0, 3, 2}; // shake, walk, gust

// Errors are rms distances from where all strands are in four substeps; shares are these over the swing: their
// rms distance from their mean there, in the head's frame.
struct LevelRow {
    std::string style;
    uint32_t guides = 0;
    double ms = 0;       // of a frame of 1/60 s, the least; 0: nothing is simulated
    double of_whole = 0; // that over what it is where all strands are simulated
    // Of the motions that were run; m, rms: how far its hair is from the truth, and how far hair swings, the truth
    // and its own, as a sim can tell, of hair without guides the truth.
    struct Found {
        double error, swing, own;
        double share() const { return error / swing; }
    };
    std::vector<Found> found;
    double all = 0;    // rms over the table's motions
    double median = 0; // of strands, in all motions
    float listed = 0;  // plait_level.share: what the library expects
};

std::vector<LevelRow> measure_levels(Contexts& contexts, const LevelsOptions& options);

// What errors are, told from a share and the hair's own swing, over what they were, where hair swings by 2 mm and more.
struct Transfer {
    const char* taught;
    double factor; // on what is told
    size_t cases;
    double within_2, under_2, under_3; // percent
    double mean, p5, p95;              // geometric mean, percentiles
};
std::vector<Transfer> transfer_of(const std::vector<LevelRow>& rows);

std::string levels_text(const std::vector<LevelRow>& rows);
std::string levels_csv(const std::vector<LevelRow>& rows);
std::string transfer_text(const std::vector<Transfer>& rows);
std::string transfer_csv(const std::vector<LevelRow>& rows); // of each level and motion
// <out>/levels.svg and .png: error over cost. False: there is no gnuplot.
bool draw_levels(const std::vector<LevelRow>& rows, const LevelsOptions& options);

} // namespace lab::levels
