// A page of results: device, driver, date, the accuracy table, the figures, the features,
// stability.
#pragma once

#include "chart/chart.hpp"
#include "features/features.hpp"
#include "grid/grid.hpp"
#include "stability/search.hpp"

namespace lab {

struct Page {
    AccuracyRun accuracy;
    AccuracyRun baselines; // a table of their own; no methods: none
    ChartRun charts;
    FeatureRun features;
    stability::Sweep stability;
    stability::Verdicts bad_input;
    std::string places; // of the stability map
    grid::GridRun grid;
};

// What the command is asked for; `write`: the folder of the page, or none is written.
struct AllOptions {
    AccuracyOptions accuracy;
    ChartOptions charts;
    FeatureOptions features;
    Choice choice;
    std::string write;
};

// Writes <folder>/lab-<device>.md and copies one figure of folder `out` beside it; the files
// written. What stands between by_hand and its end in the page that was there is kept.
std::vector<std::string> write_page(const std::string& folder, const Page& page,
                                    const std::string& out);

constexpr const char* by_hand = "<!-- by hand, kept by plait-lab -->";
constexpr const char* by_hand_end = "<!-- end -->";

std::string slug(const std::string& name); // "Intel(R) Xeon" -> "intel-r-xeon"

} // namespace lab
