// What was measured, by device: the rows of the page and of the CSV file.
#pragma once

#include <plait/plait.h>

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Options {
    uint32_t strands = 10000;           // of the rows of features
    uint32_t vertices = 32;             // per strand, of the rows of the thesis's table
    std::string write;                  // folder for the page; empty: none
    std::string csv;                    // folder for the CSV file; empty: none
    std::string json;                   // folder for a file of the rows of each device; empty: none
    std::vector<uint32_t> local_memory; // bytes, of the sweep; empty: none, but the rows
    double load = 0;                    // of the host in the minute before
};

constexpr uint32_t model_vertices = 16; // per strand, of the models' rows

// What a stage's launches take.
struct StageSums {
    double seconds = 0, calls = 0;
    double bytes = 0; // that have to move through memory at least
};

// A frame with a feature. Its stages, by name, take device time.
struct FeatureRow {
    std::string name, over; // the feature whose time it is held against
    double seconds = 0;
    std::map<std::string, StageSums> stages;
};

enum class Interhair { off, thesis, slots, exact };

// What a frame of long hair on the mannequin has besides: nothing, its capsules, and the grid.
enum class Scene { alone, bodies, everything };

struct SceneKey {
    uint32_t strands;
    std::string model;
    Scene scene;
    auto operator<=>(const SceneKey&) const = default;
};

// So many sims on one context, each with so many strands, in one call or in one for each.
struct CrowdKey {
    uint32_t sims, strands;
    std::string model;
    Scene scene;
    bool together;
    auto operator<=>(const CrowdKey&) const = default;
};

// A frame of a hero and twenty others, by the budget of the director.
struct LevelsRow {
    double median = 0, slow = 0; // s; 95 of 100 frames take no longer than `slow`
    double worst_px = 0;         // that the director expects
};

struct DeviceResults {
    plait_device_info device{};
    std::vector<FeatureRow> features;
    std::map<std::pair<uint32_t, Interhair>, double> step_seconds;    // of tressfx, by strands
    std::map<std::pair<uint32_t, std::string>, double> model_seconds; // by strands and model
    std::map<SceneKey, double> character_seconds;
    std::map<CrowdKey, double> crowd_seconds; // of a frame of all of them
    std::map<uint32_t, LevelsRow> levels;     // by the budget, ms; 0: all strands of all
    double copy_rate = 0;                     // bytes/s, read and written; 0: not measured
    double flop_rate = 0;                     // of multiply-adds, two each
};

struct Results {
    Options options;
    std::map<uint32_t, DeviceResults> devices; // by the backend's index
    std::string failures;                      // one line each
};

} // namespace bench
