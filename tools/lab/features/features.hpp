// Each feature alone: what it costs, and what leaving it out does to the hair.
#pragma once

#include "accuracy/rows.hpp"
#include "choice.hpp"
#include "common/json_reader.hpp"
#include "run/cost.hpp"

namespace lab {

struct Feature {
    std::string name;
    std::string scene;
    Json with = Json::object(), without = Json::object(); // overrides of the scene
};

struct FeatureResult {
    std::string feature, scene, model;
    double cost_with = 0, cost_without = 0; // ms per 1/60 s and million vertices
    double moved = 0;                       // rms / L between the two
    double error_with = 0,
           error_without = 0; // rms / L from the scene's reference; NaN: it has none
    std::string note;
};

struct FeatureOptions : Choice {
    std::string table;                 // features.json; "": the one of the sources
    std::vector<std::string> features; // empty: all
    std::string device, backend;
    CostOptions costs{100000, 21, false};
};

struct FeatureRun {
    plait_device_info device;
    std::vector<FeatureResult> results;
};

std::vector<Feature> read_features(const std::string& file);
FeatureRun run_features(const FeatureOptions& options);
std::string features_text(const FeatureRun& run);
std::string features_markdown(const FeatureRun& run);
std::string features_csv(const FeatureRun& run);
std::string features_json(const FeatureRun& run);

} // namespace lab
