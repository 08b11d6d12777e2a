#include "page.hpp"

#include "summary.hpp"

#include "common/file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace lab {

namespace {

std::string today() {
    const std::time_t now = std::time(nullptr);
    char date[16];
    std::strftime(date, sizeof date, "%Y-%m-%d", std::gmtime(&now));
    return date;
}

std::string head(const plait_device_info& device) {
    char version[32];
    std::snprintf(version, sizeof version, "%d.%d.%d", PLAIT_VERSION_MAJOR, PLAIT_VERSION_MINOR,
                  PLAIT_VERSION_PATCH);
    return std::string("# Accuracy and cost on ") + device.name +
           "\n\n| | |\n|---|---|\n| device | " + device.name + " |\n| platform | " +
           device.platform + " |\n| driver | " + device.driver + " |\n| backend | " +
           device.backend + " |\n| date | " + today() + " |\n| plait | " + version +
           " |\n\nWritten by `./dev lab all`. What the numbers are: [the "
           "laboratory](../../tools/lab/docs/lab.md).\n";
}

std::string baselines_of(const AccuracyRun& run) {
    if (run.methods.empty())
        return "";
    return "\n### Baselines\n\nThe same rows by what users know; what they do and do not: "
           "[baselines](../../tools/lab/docs/baselines.md).\n\n" +
           accuracy_markdown(run);
}

// The one figure that lies beside the page: of hair on a head that shakes, or else the first.
const Chart* pictured(const ChartRun& run) {
    const auto shake = std::ranges::find(run.charts, "shake",
                                         [](const Chart& chart) { return chart.family.name; });
    if (shake != run.charts.end())
        return &*shake;
    return run.charts.empty() ? nullptr : &run.charts.front();
}

std::string drawn(const ChartRun& run, const std::string& prefix, bool free) {
    std::string text;
    for (const Chart& chart : run.charts) {
        if (chart.family.free() != free)
            continue;
        const Figure figure = figure_of(chart, run.device);
        text += &chart == pictured(run)
                    ? "\n![" + figure.title + "](" + prefix + figure.name + ".svg)\n\n"
                    : "\n### " + figure.title + "\n\n";
        text += winners_markdown(figure);
        for (const std::string& line : left_out_by_reason(figure.left_out))
            text += "\nLeft out: " + line + ".\n";
    }
    return text;
}

std::string figures_of(const ChartRun& run, const std::string& prefix) {
    std::string text =
        "\n## Cost against accuracy\n\nMarkers say substeps×iterations, `b` BDF2. "
        "Crosses on the upper edge failed: N not finite, E energy out of nothing, o off "
        "the scale. Where hair moves with its head (shake, turn, walk) the error is over how far "
        "it "
        "swings: on the dashed line it is as wrong as hair that stands still. Each table "
        "says who is best from which cost on. The run leaves every figure and its points "
        "as CSV in its folder, out/lab.\n";
    text += drawn(run, prefix, false);
    const std::string free = drawn(run, prefix, true);
    if (free.empty())
        return text;
    return text +
           "\n## With the number of segments free\n\nThe error is E_total, from the limit of many "
           "segments at eighths of the length, and the cost is in ms per 1/60 s and 100,000 "
           "strands, since more segments cost more. Markers say N: substeps×iterations; a model's "
           "line "
           "joins what nothing of its own beats, the rest are dots.\n" +
           free;
}

std::string features_of(const FeatureRun& run) {
    return "\n## Each feature alone\n\nMilliseconds per 1/60 s and million vertices; *moves* is "
           "how far leaving the feature out moves the hair, errors are from the scene's "
           "reference.\n\n" +
           features_markdown(run);
}

std::string grid_of(const grid::GridRun& run) {
    if (run.rows.empty())
        return "";
    return "\n## Between strands\n\nRows 23 to 25 are of the [grid](../stages/grid.md#grid_slots) "
           "alone, "
           "the same for every model; its cost is of one step of 100,000 vertices, and its error "
           "from the field they move with, to which each strand adds a velocity of its own.\n\n" +
           grid::rows_markdown(run.rows) + "\n### " + run.figure.title + "\n\n" +
           winners_markdown(run.figure);
}

std::string stability_of(const Page& page) {
    return "\n## Stability\n\nplait's models in their settings for real time and for quality; "
           "baselines at 60 Hz alone, explicit ones with as many substeps as they need, up to "
           "1000: " +
           page.places +
           "; seven motions of the root. What the letters mean: "
           "[stability](../../tools/lab/docs/stability.md). The "
           "envelope is 60 Hz and above, N ≤ 64, Γ ≥ 1, ≤ 10 g.\n\n" +
           stability::counts_markdown(page.stability.rows) +
           "\nThe trials include one parameter at a time, far beyond hair, at 60 Hz; a letter for "
           "each value, the worse of two strands:\n\n" +
           stability::axes_markdown(page.stability.rows) +
           "\nInput that nobody means to give: borne is no crash, every other strand bitwise as "
           "without it, and the offender finite, culled or reported.\n\n" +
           stability::verdicts_markdown(page.bad_input);
}

// What people wrote into the page that is there: all between the two marks.
std::string hand_written(const std::string& file) {
    std::ifstream stream(file);
    std::ostringstream all;
    all << stream.rdbuf();
    const std::string text = all.str();
    const size_t begin = text.find(by_hand), end = text.find(by_hand_end);
    if (begin == text.npos || end == text.npos || end < begin)
        return "\n";
    const size_t from = begin + std::string(by_hand).size();
    return text.substr(from, end - from);
}

} // namespace

std::string slug(const std::string& name) {
    std::string out;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        else if (!out.empty() && out.back() != '-')
            out += '-';
    while (out.ends_with('-'))
        out.pop_back();
    return out;
}

std::vector<std::string> write_page(const std::string& folder, const Page& page,
                                    const std::string& out) {
    make_folder(folder);
    const std::string name = "lab-" + slug(page.accuracy.device.name);
    std::vector<std::string> files{folder + "/" + name + ".md"};
    const auto publish = [&](const std::string& file) {
        std::error_code error;
        const std::string to = folder + "/" + name + "-" + file;
        std::filesystem::copy_file(out + "/" + file, to,
                                   std::filesystem::copy_options::overwrite_existing, error);
        if (!error)
            files.push_back(to);
    };
    if (const Chart* chart = pictured(page.charts))
        publish(chart->family.name + ".svg");
    const std::string kept = hand_written(files[0]);
    write_text(
        head(page.accuracy.device) + "\n## In words\n\n" + by_hand + kept + by_hand_end +
            "\n\n## In short\n\nHair in motion first: error over swing, median of the strands of "
            "the figures shake, turn and walk, where hair that stands still has 1; the rod fall of "
            "Γ = 100 (rows 18a and 18b); strands of 16 segments at the first figure's cost; and "
            "trials of the stability sweep in which a strand was lost or gained energy.\n\n" +
            summary_markdown(page) +
            "\n## Accuracy\n\nBold passes its mark, `!` misses it, n/a: the "
            "model cannot do it. Why what misses does: [the "
            "laboratory](../../tools/lab/docs/lab.md#misses).\n\n" +
            accuracy_markdown(page.accuracy) + baselines_of(page.baselines) +
            figures_of(page.charts, name + "-") + grid_of(page.grid) + features_of(page.features) +
            stability_of(page),
        files[0]);
    return files;
}

} // namespace lab
