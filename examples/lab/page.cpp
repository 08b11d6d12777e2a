#include "page.hpp"

#include "common/file.hpp"

#include <cctype>
#include <cstdio>
#include <ctime>
#include <filesystem>

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
           " |\n\nWritten by `./dev lab all`. What the numbers are: [the laboratory](../lab.md).\n";
}

std::string figures_of(const ChartRun& run, const std::string& prefix) {
    std::string text =
        "\n## Cost against accuracy\n\nMarkers say substeps×iterations, `b` BDF2. "
        "Crosses on the upper edge failed: N not finite, E energy out of nothing, o off "
        "the scale. Beside each figure lies its table as CSV.\n";
    for (const Chart& chart : run.charts) {
        const Figure figure = figure_of(chart, run.device);
        text += "\n![" + figure.title + "](" + prefix + figure.name + ".svg)\n\n" +
                winners_markdown(figure);
        for (const std::string& line : left_out_by_reason(figure.left_out))
            text += "\nLeft out: " + line + ".\n";
    }
    return text;
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

std::vector<std::string> write_page(const std::string& folder, const AccuracyRun& accuracy,
                                    const ChartRun& charts, const FeatureRun& features,
                                    const std::string& figures) {
    make_folder(folder);
    const std::string name = "lab-" + slug(accuracy.device.name);
    std::vector<std::string> files{folder + "/" + name + ".md"};
    for (const Chart& chart : charts.charts)
        for (const char* kind : {".svg", ".csv"}) {
            const std::string from = figures + "/" + chart.family.name + kind;
            const std::string to = folder + "/" + name + "-" + chart.family.name + kind;
            std::error_code error;
            std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing,
                                       error);
            if (!error)
                files.push_back(to);
        }
    write_text(
        head(accuracy.device) +
            "\n## Accuracy\n\nBold passes its mark, `!` misses it, n/a: the "
            "model cannot do it.\n\n" +
            accuracy_markdown(accuracy) + figures_of(charts, name + "-") +
            "\n## Each feature alone\n\nMilliseconds per 1/60 s and million vertices; *moves* is "
            "how far leaving the feature out moves the hair, errors are from the scene's "
            "reference.\n\n" +
            features_markdown(features),
        files[0]);
    return files;
}

} // namespace lab
