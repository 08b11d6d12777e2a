#include "chart.hpp"
#include "common/file.hpp"
#include "common/json_reader.hpp"

#include <cstdio>

namespace lab {

namespace {

constexpr const char* csv_head =
    "model,baseline,segments,substeps,iterations,bdf2,error,class,"
    "ms_per_frame_per_million,ms_per_frame_per_100k_strands,kernel_ns_per_vertex,"
    "strands_at_60_hz,floor,vertices,steps,metric\n";

std::string csv_line(const Chart& chart, const ChartPoint& p) {
    char line[384];
    const Setting& s = p.method.setting;
    std::snprintf(
        line, sizeof line, "%s,%d,%u,%u,%u,%d,%.6g,%c,%.6g,%.6g,%.6g,%.6g,%.6g,%llu,%u,%s\n",
        p.method.model->label.c_str(), p.method.model->baseline(), p.segments, s.substeps,
        s.iterations, s.bdf2, p.error, p.letter ? p.letter : '.', p.cost.ms_per_frame(),
        p.ms_per_100k_strands(), 1e9 * p.cost.kernel / static_cast<double>(p.cost.vertices),
        p.cost.strands_at_60_hz(p.segments + 1), chart.floor,
        static_cast<unsigned long long>(p.cost.vertices), p.cost.runs, chart.family.metric.c_str());
    return line;
}

Json to_json(const ChartPoint& p) {
    return {{"model", p.method.model->label},
            {"baseline", p.method.model->baseline()},
            {"segments", p.segments},
            {"substeps", p.method.setting.substeps},
            {"iterations", p.method.setting.iterations},
            {"bdf2", p.method.setting.bdf2},
            {"error", p.error}, // null when it is no number
            {"class", std::string(1, p.letter ? p.letter : '.')},
            {"ms_per_frame_per_million", p.cost.ms_per_frame()},
            {"ms_per_frame_per_100k_strands", p.ms_per_100k_strands()},
            {"vertices", p.cost.vertices},
            {"steps", p.cost.runs}};
}

} // namespace

std::string chart_csv(const Chart& chart, const plait_device_info& device) {
    std::string text =
        "# " + chart.family.title + "; " + device.name + "; driver " + device.driver + "\n";
    text += csv_head;
    for (const ChartPoint& point : chart.points)
        text += csv_line(chart, point);
    return text;
}

std::string charts_csv(const ChartRun& run) {
    std::string text = std::string("figure,") + csv_head;
    for (const Chart& chart : run.charts)
        for (const ChartPoint& point : chart.points)
            text += chart.family.name + "," + csv_line(chart, point);
    return text;
}

std::string charts_json(const ChartRun& run) {
    Json figures = Json::array();
    for (const Chart& chart : run.charts) {
        Json points = Json::array();
        for (const ChartPoint& point : chart.points)
            points.push_back(to_json(point));
        figures.push_back({{"figure", chart.family.name},
                           {"title", chart.family.title},
                           {"metric", chart.family.metric},
                           {"floor", chart.floor},
                           {"points", points},
                           {"left_out", chart.left_out}});
    }
    return json_text({{"device", run.device.name},
                      {"backend", run.device.backend},
                      {"driver", run.device.driver},
                      {"figures", figures}});
}

} // namespace lab
