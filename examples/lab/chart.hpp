// Cost against accuracy, a figure a family of scenes: measured here, drawn by gnuplot.
#pragma once

#include "accuracy.hpp"
#include "cost.hpp"
#include "settings.hpp"

namespace lab {

struct Family {
    std::string name, title;
    std::string scene;
    Json overrides = Json::object();
    std::vector<std::string> needs;
};

struct ChartPoint {
    Method method;
    double error = 0; // E_rms / L; NaN: none
    char letter = 0;  // class of failure: N, E, o (off the scale); s, r: strained; 0: none
    Cost cost;
};

struct Chart {
    Family family;
    uint32_t segments = 16;
    double floor = 0; // of discretisation, at rest; NaN: not known
    std::vector<ChartPoint> points;
    std::vector<std::string> left_out; // "chain: does not bend"
};

struct ChartOptions {
    std::string table; // charts.json; "": the one of the sources
    std::vector<std::string> models, families;
    std::string device, backend, out = "out/lab";
    bool fresh = false;
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

// Points no other point beats in both cost and error, by cost.
std::vector<ChartPoint> pareto_front(const std::vector<ChartPoint>& points);

std::string chart_csv(const Chart& chart, const plait_device_info& device);
std::string gnuplot_script(const Chart& chart, const plait_device_info& device,
                           const std::string& path); // of the picture, without its extension
// Draws <out>/<family>.svg and .png; false, with a sentence on stderr, where there is no gnuplot.
bool draw(const Chart& chart, const plait_device_info& device, const std::string& out);

} // namespace lab
