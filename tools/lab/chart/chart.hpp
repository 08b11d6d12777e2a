// Cost against accuracy, a figure a family of scenes: measured here, drawn by gnuplot.
#pragma once

#include "accuracy/accuracy.hpp"
#include "common/json_reader.hpp"
#include "figure.hpp"
#include "methods/settings.hpp"
#include "run/cost.hpp"

namespace lab {

struct Family {
    std::string name, title;
    std::string scene;
    Json overrides = Json::object();
    std::vector<std::string> needs;
    std::vector<uint32_t> segments; // where their number is free: these, scored as E_total
    std::vector<Method> methods;    // empty: all in each of their settings
    std::string metric = "rms_error";
    bool free() const { return !segments.empty(); }
};

// Upper edges of figures: an error of a whole length is off the scale, and of five swings.
constexpr double length_top = 2, swing_top = 10;

struct ChartPoint {
    Method method;
    uint32_t segments = 16;
    double error = 0; // E_rms / L; NaN: none
    char letter = 0;  // class of failure: N, E, o (off the scale); s, r: strained; 0: none
    Cost cost;

    double ms_per_100k_strands() const; // and 1/60 s
};

struct Chart {
    Family family;
    double floor = 0; // of discretisation, at rest, or of the limit; NaN: not known
    std::vector<ChartPoint> points;
    std::vector<std::string> left_out; // "chain: does not bend"
};

struct ChartOptions : Choice {
    std::string table;                 // charts.json; "": the one of the sources
    std::vector<std::string> families; // empty: all
    std::string device, backend;
    CostOptions costs{100000, 21, true, 2, 30e3};
};

struct ChartRun {
    plait_device_info device;
    std::vector<Chart> charts;
    std::vector<std::string> files; // written
    bool interrupted = false;
};

std::vector<Family> read_families(const std::string& file);
ChartRun run_charts(const ChartOptions& options);

std::string chart_csv(const Chart& chart, const plait_device_info& device);
std::string charts_csv(const ChartRun& run); // all in one table
std::string charts_json(const ChartRun& run);
Figure figure_of(const Chart& chart, const plait_device_info& device);

} // namespace lab
