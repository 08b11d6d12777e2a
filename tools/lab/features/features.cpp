#include "features.hpp"

#include "accuracy/results.hpp"
#include "common/file.hpp"
#include "common/json_reader.hpp"
#include "hash.hpp"
#include "metrics/metrics.hpp"
#include "run/report.hpp"

#include "common/progress.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <optional>

namespace lab {

namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

// One for each scene.
void read_feature(JsonReader in, const std::filesystem::path& folder, std::vector<Feature>& all) {
    Feature feature;
    if (!in.text("feature", feature.name))
        in.fail("feature", "is missing: its name");
    const Json* scenes = in.value("scenes");
    if (!scenes || !scenes->is_array() || scenes->empty())
        in.fail("scenes", "is missing or no list: files beside this one");
    if (const Json* with = in.value("with"))
        feature.with = *with;
    if (const Json* without = in.value("without"))
        feature.without = *without;
    in.finish();
    for (const Json& scene : *scenes) {
        if (!scene.is_string())
            in.fail("scenes", "has " + scene.dump() + ", which is no file's name");
        feature.scene = (folder / scene.get<std::string>()).string();
        all.push_back(feature);
    }
}

// Of all vertices of all strands over the whole recording.
double difference(const Recording& a, const Recording& b, double length) {
    double sum = 0;
    size_t count = 0;
    for (size_t k = 0; k < std::min(a.frames.size(), b.frames.size()); ++k)
        for (size_t s = 0; s < a.frames[k].x.size(); ++s)
            for (size_t i = 1; i < a.frames[k].x[s].size(); ++i) {
                sum += (a.frames[k].x[s][i] - b.frames[k].x[s][i]).squaredNorm();
                ++count;
            }
    return count ? std::sqrt(sum / static_cast<double>(count)) / length : nan;
}

struct Half {
    Scene scene;
    Method method;
    Recording recording;
    double error;
    double cost = std::numeric_limits<double>::infinity(); // ms
};

// Either half's error is from the whole scene's reference.
Half run_half(Contexts& contexts, const Feature& feature, const Json& overrides) {
    const Scene whole = read_scene(feature.scene, feature.with);
    const Scene scene = read_scene(feature.scene, overrides);
    const Method method = method_of(scene);
    Half half{scene, method, record(contexts, scene, method), nan};
    if (whole.reference)
        half.error = evaluate(whole, method, half.recording, measure_of("rms_error")).value;
    return half;
}

// By turns, the least of three rounds each: what else the machine does only adds.
void time_halves(Contexts& contexts, const CostOptions& costs, Half& with, Half& without) {
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && !interrupted(); ++round)
        for (Half* half : {&with, &without}) {
            const Cost cost = measure_cost(contexts, contexts, half->scene, half->method, costs);
            half->cost = std::min(half->cost, cost.ms_per_frame());
        }
}

std::string percent(double with, double without) {
    char text[32];
    std::snprintf(text, sizeof text, "%+.0f %%", 100 * (with / without - 1));
    return text;
}

} // namespace

std::vector<Feature> read_features(const std::string& file) {
    Origin origin{file, Json::object(), {}};
    const Json document = read_json(origin);
    JsonReader top(document, origin);
    const Json* list = top.value("features");
    if (!list || !list->is_array())
        top.fail("features", "is missing or no list");
    std::vector<Feature> features;
    for (size_t i = 0; i < list->size(); ++i)
        read_feature(top.element(*list, i, "features"), std::filesystem::path(file).parent_path(),
                     features);
    top.finish();
    return features;
}

namespace {

// The five numbers of a feature, by the names they are kept under.
struct Number {
    const char* name;
    double FeatureResult::*value;
    bool cost; // depends on how it is timed
};
constexpr Number numbers[] = {
    {"ms with", &FeatureResult::cost_with, true},
    {"ms without", &FeatureResult::cost_without, true},
    {"moved", &FeatureResult::moved, false},
    {"error with", &FeatureResult::error_with, false},
    {"error without", &FeatureResult::error_without, false},
};

// What is not in the results is measured and added to them.
class Runner {
  public:
    explicit Runner(const FeatureOptions& options)
        : options_(options), contexts_(options.backend, options.device),
          results_(options.out + "/features.csv", options.fresh), device_(contexts_.device()) {}

    const plait_device_info& device() const { return device_; }

    // None where it was interrupted.
    std::optional<FeatureResult> one(const Feature& feature) {
        const Scene scene = read_scene(feature.scene, feature.with);
        FeatureResult result;
        result.feature = feature.name;
        result.scene = scene.title;
        result.model = method_of(scene).label();
        if (take_up(feature, scene, result))
            return result;
        const auto start = std::chrono::steady_clock::now();
        measure(feature, scene, result);
        if (interrupted())
            return {};
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        for (const Number& number : numbers) {
            Result kept = blank(feature, scene, number);
            kept.value = result.*number.value;
            kept.unit = number.cost ? "ms" : "L";
            kept.note = result.note;
            kept.seconds = spent.count();
            results_.add(kept);
        }
        return result;
    }

  private:
    Result blank(const Feature& feature, const Scene& scene, const Number& number) const {
        Result result;
        result.row = feature.name;
        result.variant = number.name;
        if (number.cost)
            result.variant += " " + std::to_string(options_.costs.vertices) + " x " +
                              std::to_string(options_.costs.runs);
        const Method method = method_of(scene);
        result.model = method.model->label;
        result.setting = method.setting.label();
        result.device = device_.name;
        result.backend = device_.backend;
        result.driver = device_.driver;
        result.fingerprint = fingerprint_of(feature);
        return result;
    }

    static std::string fingerprint_of(const Feature& feature) {
        Json both = Json::array();
        for (const Json* overrides : {&feature.with, &feature.without}) {
            Origin origin{feature.scene, Json::object(), {}};
            both.push_back(read_json(origin));
            both.back().merge_patch(*overrides);
        }
        return hash_of(both);
    }

    bool take_up(const Feature& feature, const Scene& scene, FeatureResult& result) const {
        for (const Number& number : numbers) {
            const Result* known = results_.find(blank(feature, scene, number).key());
            if (!known)
                return false;
            result.*number.value = known->value;
            result.note = known->note;
        }
        return true;
    }

    void measure(const Feature& feature, const Scene& scene, FeatureResult& result) {
        try {
            Half with = run_half(contexts_, feature, feature.with);
            Half without = run_half(contexts_, feature, feature.without);
            time_halves(contexts_, options_.costs, with, without);
            result.cost_with = with.cost;
            result.cost_without = without.cost;
            result.error_with = with.error;
            result.error_without = without.error;
            result.moved = difference(with.recording, without.recording, scene.length());
        } catch (const Failure& failure) { // a result, too
            result.note = failure.what();
            for (const Number& number : numbers)
                result.*number.value = nan;
        }
    }

    const FeatureOptions& options_;
    Contexts contexts_;
    Results results_;
    plait_device_info device_;
};

std::vector<Feature> choose(const FeatureOptions& options) {
    auto features = read_features(
        options.table.empty() ? std::string(PLAIT_LAB_SCENES) + "/features.json" : options.table);
    std::vector<std::string> known, scenes;
    for (const Feature& feature : features) {
        known.push_back(feature.name);
        scenes.push_back(feature.scene);
    }
    check_known("--features", options.features, known);
    check_known("--models", options.models, model_labels());
    check_scenes(options.scenes, scenes);
    std::erase_if(features, [&](const Feature& feature) {
        return !wanted(options.features, feature.name) ||
               !wanted_scene(options.scenes, feature.scene) ||
               !wanted(options.models, read_scene(feature.scene, feature.with).model);
    });
    return features;
}

} // namespace

FeatureRun run_features(const FeatureOptions& options) {
    const auto features = choose(options);
    Runner runner(options);
    FeatureRun run{runner.device(), {}};
    Progress progress("features", std::max<uint32_t>(1, static_cast<uint32_t>(features.size())));
    uint32_t done = 0;
    for (const Feature& feature : features) {
        if (interrupted())
            break;
        if (auto result = runner.one(feature))
            run.results.push_back(std::move(*result));
        progress.update(++done);
    }
    return run;
}

std::string features_text(const FeatureRun& run) {
    char line[400];
    std::snprintf(line, sizeof line, "%-26s %-30s %-20s %9s %9s %7s %9s %10s %10s\n", "feature",
                  "scene", "method", "ms with", "without", "cost", "moves", "error with",
                  "without");
    std::string text = line;
    for (const FeatureResult& r : run.results) {
        std::snprintf(line, sizeof line, "%-26s %-30s %-20s %9.4g %9.4g %7s %9s %10s %10s %s\n",
                      r.feature.c_str(), r.scene.c_str(), r.model.c_str(), r.cost_with,
                      r.cost_without, percent(r.cost_with, r.cost_without).c_str(),
                      number(r.moved).c_str(), number(r.error_with).c_str(),
                      number(r.error_without).c_str(), r.note.c_str());
        text += line;
    }
    return text + "ms per 1/60 s and million vertices; moves: rms / L between with and without; "
                  "errors: rms / L from the scene's reference\n";
}

std::string features_markdown(const FeatureRun& run) {
    std::string text =
        "| feature | scene | method | ms with | ms without | cost | moves, rms/L | "
        "error with | error without |\n|---|---|---|---:|---:|---:|---:|---:|---:|\n";
    for (const FeatureResult& r : run.results)
        text += "| " + r.feature + " | " + r.scene + " | " + r.model + " | " + number(r.cost_with) +
                " | " + number(r.cost_without) + " | " + percent(r.cost_with, r.cost_without) +
                " | " + number(r.moved) + " | " + number(r.error_with) + " | " +
                number(r.error_without) + " |" + (r.note.empty() ? "" : " " + r.note) + "\n";
    return text;
}

std::string features_csv(const FeatureRun& run) {
    std::string text = "feature,scene,method,ms_with,ms_without,moved_rms_over_L,error_with,"
                       "error_without,note\n";
    for (const FeatureResult& r : run.results) {
        text += csv_cell(r.feature) + "," + csv_cell(r.scene) + "," + csv_cell(r.model);
        for (const Number& number : numbers) {
            char cell[32];
            std::snprintf(cell, sizeof cell, ",%.9g", r.*number.value);
            text += std::isnan(r.*number.value) ? "," : cell;
        }
        text.append(",").append(csv_cell(r.note)).append("\n");
    }
    return text;
}

std::string features_json(const FeatureRun& run) {
    Json features = Json::array();
    for (const FeatureResult& r : run.results)
        features.push_back({{"feature", r.feature},
                            {"scene", r.scene},
                            {"method", r.model},
                            {"ms_with", r.cost_with}, // null when it is no number
                            {"ms_without", r.cost_without},
                            {"moved_rms_over_L", r.moved},
                            {"error_with", r.error_with},
                            {"error_without", r.error_without},
                            {"note", r.note}});
    return json_text({{"device", run.device.name},
                      {"backend", run.device.backend},
                      {"driver", run.device.driver},
                      {"features", features}});
}

} // namespace lab
