// One run of one scene, for people and for programs.
#pragma once

#include "cost.hpp"
#include "metrics/metrics.hpp"

#include <optional>

namespace lab {

// What the command is asked for. `overrides`: "key.of.the.scene", and its value as JSON, a number or a word.
struct RunOptions {
    std::string scene;
    std::vector<std::pair<std::string, std::string>> overrides;
    bool cost = true;
    CostOptions costs;
};

struct Measured {
    Measure measure;
    Value value;
    Verdict verdict;
};

struct RunReport {
    const Scene& scene;
    const Method& method;
    plait_device_info device;
    const Recording& recording;
    std::vector<Measured> measured;
    std::optional<Cost> cost;
};

// What the scene asks for, and beside it strain, jitter, energy and non-finite vertices.
std::vector<Measured> measure_all(const Scene& scene, const Method& method,
                                  const Recording& recording);

void print_report(const RunReport& report);
void print_json(const RunReport& report);

const char* verdict_word(Verdict verdict); // "pass", "MISS", ""
std::string number(double value);          // short, for tables; "-" for NaN

} // namespace lab
