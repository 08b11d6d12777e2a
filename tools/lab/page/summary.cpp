#include "summary.hpp"

#include "run/report.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>

namespace lab {

namespace {

constexpr const char* in_motion[] = {"shake", "turn", "walk"}; // figures
constexpr const char* fall_row = "18a";
constexpr const char* rest_row = "18b";
constexpr const char* fall_variant = "Γ 100";

// Of an explicit baseline, whose substeps are the scene's own, the first that is drawn.
const ChartPoint* point_of(const Page& page, const char* figure, const Method& method) {
    for (const Chart& chart : page.charts.charts) {
        if (chart.family.name != figure)
            continue;
        for (const ChartPoint& point : chart.points)
            if (point.method.model == method.model &&
                (method.setting.substeps == 0 || point.method.setting == method.setting))
                return &point;
    }
    return nullptr;
}

std::string error_of(const ChartPoint* point) {
    if (!point)
        return "";
    return number(point->error) + (point->letter ? std::string(" ") + point->letter : "");
}

std::string error_of(const AccuracyRun& run, const char* row, const Method& method) {
    for (const Result& result : run.results)
        if (result.row == row && result.variant == fall_variant &&
            result.model == method.model->label && result.setting == method.setting.label())
            return result.verdict == "cannot" ? "n/a" : number(result.value);
    return "";
}

std::string strands_of(const ChartPoint* point) {
    return point ? text("%.0f",
                        std::round(point->cost.strands_at_60_hz(point->segments + 1) / 100) * 100)
                 : "";
}

std::string failures_of(const Page& page, const Method& method) {
    using stability::Grade;
    for (const stability::Count& count : count_letters(page.stability.rows))
        if (count.method == method.label())
            return text("%zu of %zu",
                        count.letters[static_cast<size_t>(Grade::nonfinite)] +
                            count.letters[static_cast<size_t>(Grade::explosion)],
                        count.trials);
    return "";
}

std::string lines_of(const Page& page, const AccuracyRun& run) {
    std::string lines;
    for (const Method& method : run.methods) {
        lines += "| " + method.label();
        for (const char* figure : in_motion)
            lines += " | " + error_of(point_of(page, figure, method));
        lines += " | " + error_of(run, fall_row, method) + " | " + error_of(run, rest_row, method) +
                 " | " + strands_of(point_of(page, in_motion[0], method)) + " | " +
                 failures_of(page, method) + " |\n";
    }
    return lines;
}

} // namespace

std::string summary_markdown(const Page& page) {
    return "| | shake, error / swing | turn | walk | fall, rms / L | at rest | strands at 60 Hz | "
           "lost "
           "or gained energy |\n|---|---:|---:|---:|---:|---:|---:|---:|\n" +
           lines_of(page, page.accuracy) + lines_of(page, page.baselines);
}

} // namespace lab
