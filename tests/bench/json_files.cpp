#include "json_files.hpp"
#include "page.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace bench {

JsonFiles::JsonFiles(const Results& results)
    : ConsoleReporter(isatty(STDOUT_FILENO) ? OO_Color : OO_None) {
    const std::filesystem::path folder = results.options.json;
    std::filesystem::create_directories(folder);
    for (const auto& [index, device] : results.devices) {
        File& file = files_.emplace_back();
        file.rows = "device:" + std::to_string(index) + "/";
        file.path = (folder / ("bench-" + slug(device.device) + ".json")).string();
    }
}

bool JsonFiles::ReportContext(const Context& context) {
    for (File& file : files_) {
        file.stream.open(file.path);
        file.reporter.SetOutputStream(&file.stream);
        file.reporter.ReportContext(context);
    }
    return ConsoleReporter::ReportContext(context);
}

void JsonFiles::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    for (File& file : files_) {
        std::vector<Run> own;
        std::ranges::copy_if(runs, std::back_inserter(own), [&](const Run& run) {
            return run.benchmark_name().starts_with(file.rows);
        });
        if (!own.empty())
            file.reporter.ReportRuns(own);
    }
}

void JsonFiles::Finalize() {
    ConsoleReporter::Finalize();
    for (File& file : files_) {
        file.reporter.Finalize();
        file.stream.close();
        if (!file.stream)
            throw std::runtime_error(file.path + ": cannot be written");
    }
}

} // namespace bench
