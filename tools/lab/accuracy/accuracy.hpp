// The accuracy table: every row by every method, on one device.
#pragma once

#include "choice.hpp"
#include "results.hpp"
#include "rows.hpp"

namespace lab {

struct AccuracyOptions : Choice {
    std::string table;             // accuracy.json; "": the one of the sources
    std::vector<std::string> rows; // empty: all
    std::string device, backend;
    bool all_settings = false, baselines = false;
};

struct AccuracyRun {
    plait_device_info device;
    std::vector<Row> rows; // that were asked for
    std::vector<Method> methods;
    std::vector<Result> results; // row by row, variant by variant, method by method
    bool interrupted = false;
};

AccuracyRun run_accuracy(const AccuracyOptions& options);

std::string accuracy_text(const AccuracyRun& run);     // for a terminal
std::string accuracy_markdown(const AccuracyRun& run); // for a page

// The models and baselines named, or the library's models; with `baselines` all.
std::vector<const Model*> models_of(const std::vector<std::string>& labels, bool baselines);
// They, with the settings they are measured with.
std::vector<Method> methods_of(const std::vector<std::string>& models, bool baselines,
                               bool all_settings);

} // namespace lab
