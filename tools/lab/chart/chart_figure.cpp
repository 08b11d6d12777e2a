#include "chart.hpp"

#include "metrics/metrics.hpp"

#include <iterator>

namespace lab {

namespace {

// Okabe and Ito's colours: told apart by everyone, and in grey.
const char* colour_of(const std::string& model, size_t index) {
    if (model == "tressfx")
        return "#D55E00";
    if (model == "chain")
        return "#0072B2";
    if (model == "cosserat")
        return "#009E73";
    if (model == "rod")
        return "#8E3B8F";
    if (model == "articulated")
        return "#CC0033";
    constexpr const char* others[] = {"#7F7F7F", "#E69F00", "#56B4E9",
                                      "#A0522D", "#4D4D4D", "#B8A000"};
    return others[index % std::size(others)];
}

// "4×2", "4×2 b" with BDF2, and "32: 4×2" where the number of segments is free.
Dot dot_of(const ChartPoint& point, bool free) {
    const Setting& s = point.method.setting;
    const std::string segments = std::to_string(point.segments);
    return {free ? point.ms_per_100k_strands() : point.cost.ms_per_frame(),
            point.error,
            point.method.label() + (free ? ", N " + segments : ""),
            (free ? segments + ": " : "") + std::to_string(s.substeps) + "×" +
                std::to_string(s.iterations) + (s.bdf2 ? " b" : ""),
            point.letter,
            point.method.model->baseline()};
}

void of_swing(Figure& figure) {
    figure.error_axis = "error / swing, median of the strands";
    figure.floor_label = "hair that stands still";
    figure.bands = false;
    figure.top = swing_top;
}

void of_free_segments(Figure& figure) {
    figure.error_axis = "E_{total}, rms / L";
    figure.cost_axis = "ms per 1/60 s of simulated time and 100,000 strands";
    figure.strands = 1e3 / 60 * 1e5;
    figure.floor_label = "error of the reference";
    figure.band_label = "indistinguishable";
    figure.own_fronts = true;
}

} // namespace

double ChartPoint::ms_per_100k_strands() const {
    return 0.1 * cost.ms_per_frame() * (segments + 1);
}

Figure figure_of(const Chart& chart, const plait_device_info& device) {
    Figure figure;
    figure.name = chart.family.name;
    figure.title = chart.family.title;
    figure.subtitle = std::string(device.name) + ", " + device.backend;
    if (counts_over_swing(chart.family.metric))
        of_swing(figure);
    if (chart.family.free())
        of_free_segments(figure);
    else if (!chart.points.empty())
        figure.strands = 1e3 / 60 * 1e6 / (chart.points[0].segments + 1);
    figure.floor = chart.floor;
    figure.left_out = chart.left_out;
    size_t baselines = 0;
    for (const ChartPoint& point : chart.points) {
        const Model& model = *point.method.model;
        const std::string name = model.label + (model.baseline() ? " (baseline)" : "");
        if (figure.series.empty() || figure.series.back().name != name) {
            figure.series.push_back(
                {name, colour_of(model.label, baselines), model.baseline(), {}});
            baselines += model.baseline();
        }
        figure.series.back().dots.push_back(dot_of(point, chart.family.free()));
    }
    return figure;
}

} // namespace lab
