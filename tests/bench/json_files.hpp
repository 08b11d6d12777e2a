// The rows as Google Benchmark prints them, and in a JSON file of each device.
#pragma once

#include "results.hpp"

#include <benchmark/benchmark.h>

#include <fstream>
#include <list>
#include <string>

namespace bench {

// bench-<device>.json in options.json, of Google Benchmark's format.
class JsonFiles : public benchmark::ConsoleReporter {
  public:
    explicit JsonFiles(const Results& results);
    bool ReportContext(const Context& context) override;
    void ReportRuns(const std::vector<Run>& runs) override;
    void Finalize() override; // throws where a file could not be written

  private:
    struct File {
        std::string rows; // how the names of its rows begin
        std::string path;
        std::ofstream stream;
        benchmark::JSONReporter reporter;
    };
    std::list<File> files_;
};

} // namespace bench
